'use strict';
// The page asks for JSON beside its own address and shows it. Everything that comes from a run goes onto the page as text,
// never as markup: names may hold anything.
const MOST = 6, FAST = 2000, SLOW = 10000;
const byId = (id) => document.getElementById(id);
const runs = [];            // what is known of each: short, whole, curves, marks of what was asked for
const chosen = new Set();   // numbers of the runs below
const shown = new Map();    // column key -> chart
let columnsChosen = false, follow = true, allOver = false;

function make(tag, attributes, ...inside) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) element.setAttribute(name, value);
  element.append(...inside);
  return element;
}
function write(element, text) { if (element.textContent !== text) element.textContent = text; }
async function ask(what) {
  const answer = await fetch(what, {cache: 'no-store', credentials: 'omit'});
  if (answer.status === 404) return null;
  if (!answer.ok) throw new Error('status ' + answer.status);
  return answer.json();
}

// --- numbers for people ---
const prefixes = [[1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, ''], [1e-3, 'm'], [1e-6, 'µ'], [1e-9, 'n'], [1e-12, 'p']];
const prefixed = new Set(['s', 'm', 'Pa', 'J', 'N', 'W', 'Hz', 'm/s', 'J/kg', 'J/m3', 'W/m2', 'N/m']);
const raised = (text) => String(text).replace(/[-0-9]/g, (c) => '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'['-0123456789'.indexOf(c)]);
const pretty = (unit) => unit.replace(/([a-zA-Z])(-?\d+)/g, (all, letter, power) => letter + raised(power));
function scaleOf(size, unit) { // what to divide by, and the unit then
  if (!(size > 0) || !isFinite(size)) return [1, pretty(unit === '1' ? '' : unit)];
  if (prefixed.has(unit)) {
    const [factor, letter] = prefixes.find(([f]) => size >= 0.9999 * f) || prefixes[prefixes.length - 1];
    return [factor, letter + pretty(unit)];
  }
  const bare = pretty(unit === '1' ? '' : unit);
  if (size >= 1e-2 && size < 1e5) return [1, bare];
  const power = 3 * Math.floor(Math.log10(size) / 3);
  return [10 ** power, '10' + raised(power) + (bare ? ' ' + bare : '')];
}
const digits = (x, n) => String(Number(x.toPrecision(n)));
function quantity(x, unit, like) {
  if (x === null || x === undefined) return '–';
  const [factor, name] = scaleOf(Math.abs(like || x), unit);
  return digits(x / factor, 4) + (name ? ' ' + name : '');
}
function duration(s) {
  if (s === null || s === undefined) return '–';
  s = Math.round(s);
  const two = (n) => String(n).padStart(2, '0');
  if (s < 3600) return Math.floor(s / 60) + ':' + two(s % 60) + ' min';
  if (s < 86400) return Math.floor(s / 3600) + ':' + two(Math.floor(s / 60) % 60) + ' h';
  return Math.floor(s / 86400) + ' d ' + Math.floor(s / 3600) % 24 + ' h';
}
const ago = (s) => s === null ? '–' : s < 2 ? 'just now' : s < 120 ? Math.round(s) + ' s ago' : duration(s) + ' ago';
const count = (n) => n === null || n === undefined ? '–' : Math.round(n).toLocaleString('en').replace(/,/g, '\u2009');
// What went wrong: cells of first order and steps tried again. Relaxing and clipping are everyday work (their table below).
const rescues = (guard) => guard.fallback === null ? null : guard.fallback + guard.retries;
const color = (run) => 'var(--c' + [...chosen].sort((a, b) => a - b).indexOf(run) % 6 + ')';
const isAtWork = (run) => run.short.life === 'running' || run.short.life === 'quiet';
const pillClass = (life) => 'pill ' + (life === 'quiet' ? 'quiet-run' : life);

// --- the list of runs ---
function listRow(run) {
  const box = make('input', {type: 'checkbox', 'aria-label': 'show this run'});
  box.addEventListener('change', () => {
    if (box.checked && chosen.size >= MOST) box.checked = false;
    else if (box.checked) chosen.add(run.index);
    else chosen.delete(run.index);
    refresh();
  });
  const cell = {};
  const row = make('tr', {}, make('td', {}, box));
  for (const name of ['name', 'life', 'bar', 'time', 'step', 'left', 'guard'])
    row.append(cell[name] = make('td', {class: name === 'name' || name === 'bar' ? name : ''}));
  cell.pill = make('span', {});
  cell.life.append(cell.pill);
  cell.fill = make('i', {});
  cell.bar.append(make('div', {class: 'track'}, cell.fill));
  byId('list').append(row);
  return Object.assign(cell, {box});
}
function drawList() {
  byId('runs').hidden = runs.length < 2;
  if (runs.length < 2) return;
  for (const run of runs) {
    const cell = run.row = run.row || listRow(run), short = run.short;
    cell.box.checked = chosen.has(run.index);
    write(cell.name, short.name);
    write(cell.pill, short.life);
    cell.pill.className = pillClass(short.life);
    cell.fill.style.width = (short.percent || 0) + '%';
    write(cell.time, quantity(short.t, 's', short.until));
    write(cell.step, count(short.step));
    write(cell.left, isAtWork(run) ? duration(short.left_s) : '');
    write(cell.guard, count(rescues(short.guard)));
  }
}

// --- a card for each chosen run ---
const facts = [
  ['time', (s) => {
    const [by, unit] = scaleOf(s.until || s.t, 's');
    return (s.t === null ? '–' : digits(s.t / by, 4)) + (s.until === null ? ' ' : ' of ' + digits(s.until / by, 4) + ' ') + unit;
  }],
  ['step', (s) => count(s.step)],
  ['time step', (s) => quantity(s.dt, 's')],
  ['left, at the mean pace', (s) => duration(s.left_s)],
  ['written', (s) => ago(s.silent_s)],
  ['fallback + retries', (s) => count(rescues(s.guard))],
  ['started', (s) => s.started ? new Date(s.started).toLocaleString([], {dateStyle: 'short', timeStyle: 'short'}) : '–'],
  ['ranks', (s) => count(s.ranks)],
];
function cardOf(run) {
  const card = {root: make('article', {class: 'card'}), title: make('h3'), pill: make('span'), percent: make('span'),
                says: make('p', {class: 'says'}), fill: make('i'), values: []};
  const list = make('dl', {class: 'facts'});
  for (const [name] of facts) {
    const value = make('dd');
    card.values.push(value);
    list.append(make('div', {}, make('dt', {}, name), value));
  }
  card.root.append(card.title, make('p', {}, card.pill, ' ', card.percent), card.says,
                   make('div', {class: 'track'}, card.fill), list);
  return card;
}
function drawCards() {
  const wanted = [...chosen].sort((a, b) => a - b).map((index) => runs[index]);
  for (const run of wanted) {
    const short = run.short, card = run.card = run.card || cardOf(run);
    write(card.title, runs.length > 1 ? short.name : short.title || short.name);
    card.title.hidden = runs.length < 2;
    write(card.pill, short.life);
    card.pill.className = pillClass(short.life);
    write(card.percent, short.percent === null ? '' : Math.floor(short.percent) + ' %');
    write(card.says, short.says + (short.reason && !/^finished$/.test(short.reason) ? ' (' + short.reason + ')' : ''));
    card.fill.style.width = (short.percent || 0) + '%';
    facts.forEach(([, text], i) => write(card.values[i], text(short)));
    for (const name of [3]) card.values[name].parentNode.hidden = !isAtWork(run);
  }
  const cards = wanted.map((run) => run.card.root), place = byId('now');
  if (cards.length !== place.children.length || cards.some((c, i) => place.children[i] !== c)) place.replaceChildren(...cards);
}

// --- curves ---
const keyOf = (column) => column.file + '\n' + column.name;
function allColumns() {
  const all = new Map();
  for (const index of chosen)
    for (const column of (runs[index].whole || {columns: []}).columns)
      if (column.name !== 't' && column.name !== 'step' && !all.has(keyOf(column))) all.set(keyOf(column), column);
  return all;
}
function drawColumns() {
  const all = allColumns(), place = byId('columns');
  byId('curves').hidden = all.size === 0;
  if (!columnsChosen && all.size) {
    columnsChosen = true;
    const plain = [...all.values()].filter((c) => c.name !== 'dt' && !c.name.startsWith('guard_'));
    for (const column of plain.slice(0, 4)) shown.set(keyOf(column), null);
  }
  const keys = [...all.keys()].join('\n\n');
  if (place.dataset.keys === keys) return;
  place.dataset.keys = keys;
  place.replaceChildren(...[...all].map(([key, column]) => {
    const box = make('input', {type: 'checkbox'});
    box.checked = shown.has(key);
    box.addEventListener('change', () => {
      if (box.checked) shown.set(key, null);
      else { if (shown.get(key)) shown.get(key).root.remove(); shown.delete(key); }
      refresh();
    });
    return make('label', {}, box, column.name);
  }));
}
const svg = (tag, attributes, text) => {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  if (text !== undefined) element.textContent = text;
  return element;
};
function chartOf(column) {
  const chart = {column, log: false, root: make('div', {class: 'chart'}), name: make('b', {}, column.name),
                 value: make('div', {class: 'value'}), drawing: svg('svg', {role: 'img'})};
  const button = make('button', {type: 'button', 'aria-pressed': 'false'}, 'log');
  button.addEventListener('click', () => {
    chart.log = !chart.log;
    button.setAttribute('aria-pressed', chart.log);
    drawChart(chart);
  });
  chart.drawing.addEventListener('pointermove', (event) => pointAt(chart, event));
  chart.drawing.addEventListener('pointerleave', () => { chart.pointer = null; drawChart(chart); });
  chart.root.append(make('header', {}, chart.name, button), chart.drawing, chart.value);
  return chart;
}
function ticks(lo, hi, most) {
  const raw = (hi - lo) / most, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.9999);
  const list = [];
  for (let i = Math.ceil(lo / step - 1e-9); i * step <= hi + 1e-9 * step; i++) list.push(i * step);
  return list;
}
function decades(lo, hi) {
  const list = [], from = Math.ceil(lo - 1e-9), every = Math.max(1, Math.ceil((hi - lo) / 5));
  for (let p = from; p <= hi + 1e-9; p += every) list.push(p);
  return list.length > 1 ? list : [lo, hi];
}
function linesOf(chart) {
  const key = keyOf(chart.column), lines = [];
  for (const index of [...chosen].sort((a, b) => a - b)) {
    const curve = runs[index].curves.get(key);
    if (curve && curve.t) lines.push({index, curve});
  }
  return lines;
}
function rangeOf(lines, log) {
  let tLo = Infinity, tHi = -Infinity, lo = Infinity, hi = -Infinity;
  for (const {curve} of lines)
    curve.t.forEach((t, i) => {
      const v = curve.v[i];
      if (t === null) return;
      tLo = Math.min(tLo, t); tHi = Math.max(tHi, t);
      if (v === null || (log && v <= 0)) return;
      lo = Math.min(lo, v); hi = Math.max(hi, v);
    });
  if (!(tHi > tLo)) tHi = tLo + (Math.abs(tLo) || 1) * 1e-3;
  if (!(hi >= lo)) return null;
  if (log) { lo = Math.log10(lo); hi = Math.log10(hi); }
  const least = log ? 0.5 : 2e-3 * Math.max(Math.abs(lo), Math.abs(hi)) || 1; // round-off is a straight line
  const pad = Math.max((hi - lo) * 0.05, 0.5 * (least - (hi - lo)));
  return {tLo, tHi, lo: lo - pad, hi: hi + pad, size: log ? 0 : Math.max(Math.abs(lo), Math.abs(hi))};
}
function drawChart(chart) {
  const lines = linesOf(chart), drawing = chart.drawing, width = drawing.clientWidth || 480, height = 220;
  const range = rangeOf(lines, chart.log), left = 58, right = 12, top = 10, bottom = 28;
  drawing.setAttribute('viewBox', '0 0 ' + width + ' ' + height);
  drawing.setAttribute('aria-label', chart.column.name + ' against time');
  drawing.replaceChildren();
  chart.geometry = null;
  if (!range) {
    const curve = lines.length ? null : [...chosen].map((i) => runs[i].curves.get(keyOf(chart.column))).find((c) => c && c.fault);
    write(chart.value, '');
    drawing.append(svg('text', {x: left, y: 40}, curve ? curve.fault : chart.log ? 'no values above 0' : 'no rows yet'));
    return;
  }
  const [by, unit] = chart.log ? [1, pretty(chart.column.unit === '1' ? '' : chart.column.unit)] : scaleOf(range.size, chart.column.unit);
  const [tBy, tUnit] = scaleOf(Math.max(Math.abs(range.tLo), Math.abs(range.tHi)), 's');
  const x = (t) => left + (t - range.tLo) / (range.tHi - range.tLo) * (width - left - right);
  const y = (v) => height - bottom - ((chart.log ? Math.log10(v) : v) - range.lo) / (range.hi - range.lo) * (height - top - bottom);
  write(chart.name, chart.column.name + (unit ? ' [' + unit + ']' : ''));
  for (const tick of chart.log ? decades(range.lo, range.hi) : ticks(range.lo / by, range.hi / by, 5)) {
    const value = chart.log ? 10 ** tick : tick * by, at = y(value);
    drawing.append(svg('line', {x1: left, x2: width - right, y1: at, y2: at}),
                   svg('text', {x: left - 6, y: at + 4, 'text-anchor': 'end'},
                       chart.log ? (Number.isInteger(tick) ? '10' + raised(tick) : value.toExponential(1)) : digits(tick, 6)));
  }
  ticks(range.tLo / tBy, range.tHi / tBy, Math.max(3, width / 110)).forEach((tick, i, all) => {
    const at = x(tick * tBy), last = i === all.length - 1, outside = last && at > width - right - 14;
    drawing.append(svg('text', {x: outside ? width : at, y: height - 10, 'text-anchor': outside ? 'end' : 'middle'},
                       digits(tick, 6) + (last ? ' ' + tUnit : '')));
  });
  for (const {index, curve} of lines) {
    let path = '', open = false;
    curve.t.forEach((t, i) => {
      const v = curve.v[i];
      if (t === null || v === null || (chart.log && v <= 0)) { open = false; return; }
      path += (open ? 'L' : 'M') + x(t).toFixed(1) + ' ' + y(v).toFixed(1);
      open = true;
    });
    const line = svg('path', {d: path});
    line.style.stroke = color(index);
    drawing.append(line);
  }
  chart.geometry = {x, range, left, right, width, height, tUnit};
  drawPointer(chart, lines);
}
function pointAt(chart, event) {
  const box = chart.drawing.getBoundingClientRect();
  chart.pointer = (event.clientX - box.left) / box.width;
  drawChart(chart);
}
function drawPointer(chart, lines) {
  const {x, range, left, right, width, height} = chart.geometry;
  if (chart.pointer === null || chart.pointer === undefined) {
    const last = lines.map(({curve}) => quantity(curve.v[curve.v.length - 1], chart.column.unit, range.size));
    write(chart.value, 'last: ' + last.join(' · '));
    return;
  }
  const at = range.tLo + (chart.pointer * width - left) / (width - left - right) * (range.tHi - range.tLo);
  const texts = lines.map(({curve}) => {
    let near = 0;
    curve.t.forEach((t, i) => { if (Math.abs(t - at) < Math.abs(curve.t[near] - at)) near = i; });
    return {t: curve.t[near], text: quantity(curve.v[near], chart.column.unit, range.size)};
  });
  if (!texts.length) return;
  const cross = x(texts[0].t);
  chart.drawing.append(svg('line', {class: 'cross', x1: cross, x2: cross, y1: 10, y2: height - 28}));
  write(chart.value, 't = ' + quantity(texts[0].t, 's', range.tHi) + ': ' + texts.map((o) => o.text).join(' · '));
}
function drawCharts() {
  const all = allColumns(), place = byId('charts');
  for (const [key, chart] of shown) {
    if (!all.has(key)) { if (chart) chart.root.hidden = true; continue; }
    const live = chart || chartOf(all.get(key));
    shown.set(key, live);
    live.root.hidden = false;
    live.column = all.get(key);
    if (!live.root.parentNode) place.append(live.root);
    drawChart(live);
  }
  byId('legend').replaceChildren(...(chosen.size < 2 ? [] : [...chosen].sort((a, b) => a - b).map((index) => {
    const swatch = make('span', {class: 'swatch'});
    swatch.style.background = color(index);
    return make('span', {}, swatch, runs[index].short.name);
  })));
}

// --- pictures ---
function pictureOf(run) {
  const image = make('img', {alt: ''}), caption = make('figcaption');
  const figure = {root: make('figure', {}, image, caption), image, caption};
  image.addEventListener('error', () => { if (image.getAttribute('src')) write(caption, 'this picture cannot be drawn'); });
  return figure;
}
function drawPictures() {
  const wanted = [...chosen].sort((a, b) => a - b).map((i) => runs[i]).filter((r) => r.whole && r.whole.times.length && r.whole.fields.length);
  const select = byId('field'), slider = byId('when'), names = [...new Set(wanted.flatMap((r) => r.whole.fields))];
  byId('pictures').hidden = !wanted.length;
  if (!wanted.length) return;
  if (select.dataset.names !== names.join('\n')) {
    const kept = select.value || (names.includes('pressure') ? 'pressure' : names[0]);
    select.dataset.names = names.join('\n');
    select.replaceChildren(...names.map((name) => make('option', {value: name}, name)));
    select.value = names.includes(kept) ? kept : names[0];
  }
  const most = Math.max(...wanted.map((r) => r.whole.times.length)) - 1;
  slider.max = most;
  if (follow) slider.value = most;
  write(byId('which'), follow ? 'latest' : (Number(slider.value) + 1) + ' of ' + (most + 1));
  byId('same').parentNode.hidden = wanted.length < 2;
  const shows = wanted.filter((run) => run.whole.fields.includes(select.value)).map((run) => {
    const last = run.whole.times.length - 1;
    return {run, at: follow ? last : Math.min(Number(slider.value), last)};
  });
  for (const run of wanted) (run.figure = run.figure || pictureOf(run)).root.hidden = !shows.some((show) => show.run === run);
  for (const {run, at} of shows) {
    const whole = run.whole, figure = run.figure, others = byId('same').checked ? shows.filter((show) => show.run !== run) : [];
    // the last part is for the browser alone: another time is another picture
    const source = 'picture?run=' + run.index + '&snapshot=' + at + '&field=' + whole.fields.indexOf(select.value) +
      others.map((show, i) => '&run' + (i + 1) + '=' + show.run.index + '&snapshot' + (i + 1) + '=' + show.at).join('') +
      '&t=' + whole.times[at];
    if (figure.image.getAttribute('src') === source) continue;
    figure.image.setAttribute('src', source);
    figure.image.alt = select.value + ' of ' + whole.name;
    write(figure.caption, (runs.length > 1 ? whole.name + ', ' : '') + select.value + ' at t = ' + quantity(whole.times[at], 's', whole.until));
  }
  const figures = wanted.map((run) => run.figure.root), place = byId('images');
  place.className = figures.length > 1 ? 'images' : 'images one';
  if (figures.length !== place.children.length || figures.some((f, i) => place.children[i] !== f)) place.replaceChildren(...figures);
}

// --- guard, expectations, log ---
function drawRest() {
  const wanted = [...chosen].sort((a, b) => a - b).map((i) => runs[i]);
  const guarded = wanted.filter((r) => rescues(r.short.guard) !== null);
  byId('guards').hidden = !guarded.length;
  byId('guard').replaceChildren(...guarded.map((r) => make('tr', {}, make('td', {class: 'name'}, r.short.name),
    ...['fallback', 'relaxed', 'clipped', 'retries'].map((name) => make('td', {}, count(r.short.guard[name]))))));
  const judged = wanted.filter((r) => r.whole && r.whole.expect.length);
  byId('expected').hidden = !judged.length;
  byId('expect').replaceChildren(...judged.map((r) => make('div', {class: 'wide'}, make('p', {class: 'quiet'}, wanted.length > 1 ? r.short.name : ''),
    make('table', {}, ...r.whole.expect.map((e) => make('tr', {}, make('td', {class: 'name'}, e.what || ''),
      make('td', {}, e.value === null ? e.fault || 'not finite' : digits(e.value, 6)), make('td', {}, e.bound || ''),
      make('td', {class: e.passed ? 'finished' : 'failed'}, e.passed ? 'holds' : 'does not hold')))))));
  const logged = wanted.filter((r) => r.whole && r.whole.log.length), place = byId('log');
  byId('logs').hidden = !logged.length;
  const text = JSON.stringify(logged.map((r) => [r.index, r.whole.log]));
  if (place.dataset.text === text) return;
  place.dataset.text = text;
  place.replaceChildren(...logged.flatMap((r) => [make('p', {class: 'quiet'}, wanted.length > 1 ? r.short.name : ''), make('pre', {}, r.whole.log.join('\n'))]));
  for (const pre of place.querySelectorAll('pre')) pre.scrollTop = pre.scrollHeight;
}

// --- asking ---
function draw() {
  const one = runs.length === 1 ? runs[0].short : null, name = one ? one.title || one.name : runs.length + ' runs';
  const at = one && one.percent !== null ? Math.floor(one.percent) + ' % ' : '';
  write(byId('title'), runs.length ? name : 'Nothing has run here yet');
  write(byId('place'), one && one.title ? one.name : '');
  document.title = at + (runs.length ? name : 'bulla watch');
  drawList();
  drawCards();
  drawColumns();
  drawCharts();
  drawPictures();
  drawRest();
}
const markOf = (short) => [short.life, short.t, short.step].join(' ');
async function askRun(run) {
  const mark = markOf(run.short);
  if (run.mark !== mark || isAtWork(run)) {
    const whole = await ask('run?run=' + run.index);
    if (whole) run.whole = whole;
    run.mark = mark;
  }
  if (!run.whole) return;
  drawColumns();
  for (const key of shown.keys()) {
    const column = run.whole.columns.findIndex((c) => keyOf(c) === key);
    if (column < 0 || run.asked.get(key) === mark) continue;
    const curve = await ask('curve?run=' + run.index + '&column=' + column);
    if (curve && curve.name === run.whole.columns[column].name) run.curves.set(key, curve);
    run.asked.set(key, mark);
  }
}
async function look() {
  const state = await ask('state');
  if (!state) throw new Error('another token');
  state.runs.forEach((short, index) => {
    if (!runs[index]) {
      runs[index] = {index, curves: new Map(), asked: new Map()};
      if (chosen.size < (state.runs.length > 1 ? 3 : 1)) chosen.add(index);
    }
    runs[index].short = short;
  });
  for (const index of chosen) await askRun(runs[index]);
}
let timer = null, busy = false, again = false;
async function refresh() {
  if (busy) { again = true; return; }
  busy = true;
  clearTimeout(timer);
  const begun = performance.now();
  try {
    await look();
    draw();
    byId('news').hidden = true;
    allOver = !runs.some(isAtWork);
  } catch (error) {
    const news = byId('news');
    if (news.hidden) write(news, 'bulla watch does not answer any more: what stands here is from ' + new Date().toLocaleTimeString() + '. The runs do not need it.');
    news.hidden = false;
    allOver = true;
  }
  busy = false;
  document.body.dataset.looked = Number(document.body.dataset.looked || 0) + 1;
  if (again) { again = false; refresh(); return; }
  timer = setTimeout(refresh, Math.max(allOver || document.hidden ? SLOW : FAST, 9 * (performance.now() - begun)));
}
byId('field').addEventListener('change', draw);
byId('same').addEventListener('change', drawPictures);
byId('when').addEventListener('input', () => {
  follow = byId('when').value === byId('when').max;
  drawPictures();
});
addEventListener('resize', () => { if (runs.length) drawCharts(); });
document.addEventListener('visibilitychange', () => { if (!document.hidden) refresh(); });
refresh();
