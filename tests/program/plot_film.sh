# Films and pictures of runs beside each other: one scale for all frames and panels, a frame for each snapshot, with ffmpeg, with
# one that fails, and without.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
run() { # DIR PRESSURE UNTIL OPTIONS...
    cat >"$1.yaml" <<CASE
bulla: 1
title: A box of two gases
domain:
  lower: [0, 0]
  upper: [1 m, 1 m]
  cells: [16, 16]
  boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting}
mesh: {tile: 16}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1 bar}
  - {box: {lower: [0, 0], upper: [0.5 m, 1 m]}, material: air, density: 1.4, pressure: $2}
run: {until: $3}
output: {directory: $1, snapshots: {every: 1 us, fields: [pressure, density]}}
CASE
    "$BULLA" run "$1.yaml" --quiet
}
run low '2 bar' '4 us'
run high '4 bar' '6 us'
plot="$BULLA plot"

# --- without ffmpeg: the frames, on the scale of the whole run ---
none=$PWD/none
mkdir none
PATH=$none $plot low pressure --movie film.mp4 --width 400 --fps 5 >out 2>err
frames=$(cat out)
grep -q "there is no ffmpeg here.*cd $frames && ffmpeg .* -framerate 5 -i 'frame_%06d.png' .*film.mp4" err || fail "no advice" err
[ ! -e film.mp4 ] && [ "$(ls "$frames" | wc -l)" = 5 ]
mkdir all
$plot low pressure --all --width 400 -o all >/dev/null
index=0
for file in all/*.png; do
    cmp "$file" "$frames/$(printf 'frame_%06d.png' "$index")"
    index=$((index + 1))
done
rm -r "$frames"

# --- beside each other: one scale, of both; names of the runs, as their titles are the same ---
at="--beside --time 0 --width 800"
$plot low high pressure $at -o one.png >out
[ "$(cat out)" = one.png ]
$plot low high pressure $at -o two.png --range 1bar,4bar >out
cmp one.png two.png || fail "the scale is not that of both"
$plot low high pressure $at -o three.png --range 1bar,2bar >out
! cmp -s one.png three.png
$plot high low pressure --beside >out
[ "$(cat out)" = high/plots/beside_pressure.png ]
width() { od -An -tu1 -j16 -N4 "$1" | awk '{ print (($1 * 256 + $2) * 256 + $3) * 256 + $4 }'; }
[ "$(width one.png)" = 800 ]
$plot low high low density --beside --width 1200 -o six.png >out
[ "$(width six.png)" = 1200 ]

# A film of both goes on as long as the longer one; a scale that is given is one, too.
PATH=$none $plot high low pressure --beside --movie two.webm --width 400 >out 2>err
[ "$(ls "$(cat out)" | wc -l)" = 7 ]
cp "$(cat out)/frame_000000.png" first.png
rm -r "$(cat out)"
PATH=$none $plot high low pressure --beside --movie two.webm --width 400 --range 1bar,4bar >out 2>err
cmp first.png "$(cat out)/frame_000000.png"
rm -r "$(cat out)"

# --- with ffmpeg: what it is told, wherever the film goes; nothing else is left ---
mkdir fake 'a %d;b'
cat >fake/ffmpeg <<'FAKE'
#!/bin/sh
printf '%s\n' "$@" >"$TOLD"
for last; do :; done
[ "$last" != film.gif ] && cat frame_*.png >"$last"
FAKE
chmod +x fake/ffmpeg
TOLD=$PWD/told PATH=$PWD/fake:$PATH $plot low pressure --movie "a %d;b/-x.mp4" --width 400 >out
[ "$(cat out)" = "a %d;b/-x.mp4" ] && [ -s "a %d;b/-x.mp4" ] && [ "$(ls "a %d;b")" = -x.mp4 ] || fail "no film" out
[ "$(sed -n '/-framerate/{n;p}' told)" = 12 ] && grep -qx libx264 told && grep -qx yuv420p told || fail "told" told
code=0
TOLD=$PWD/told PATH=$PWD/fake:$PATH $plot low pressure --movie bad.gif --width 400 >out 2>err || code=$?
[ "$code" = 3 ] && grep -q 'ffmpeg fails; the 5 frames are in bad_frames_' err && [ "$(ls bad_frames_*/ | wc -l)" = 5 ] || fail "a failure" err
rm -r bad_frames_*
if command -v ffmpeg >/dev/null && ffmpeg -hide_banner -encoders 2>/dev/null | grep -q libx264; then
    for film in real.mp4 real.gif; do
        $plot low high density --beside --movie $film --width 400 >out
        [ "$(ffprobe -v error -count_frames -show_entries stream=width,nb_read_frames -of csv=p=0 $film)" = 400,7 ] || fail "$film"
    done
fi
[ -z "$(ls -d -- *_frames_* 2>/dev/null)" ] || fail "frames are left"

# --- what cannot be ---
refused "a film ends in .mp4, .webm or .gif" $plot low pressure --movie film.avi
refused "a film ends" $plot low pressure --movie film
refused "no field 'presure'.*did you mean 'pressure'" $plot low presure --movie film.mp4
refused "show one field of a plane" $plot low pressure,density --movie film.mp4
refused "a film has one name" $plot low pressure --movie film.mp4 -o film.png
refused "every snapshot" $plot low pressure --movie film.mp4 --time 1us
refused "films are of snapshots" $plot low high history m --movie film.mp4
refused "at most 120 frames" $plot low pressure --movie film.mp4 --fps 1000
refused "for a film" $plot low pressure --fps 10
refused "for several runs" $plot low pressure --beside
refused "goes by time" $plot low high pressure --beside --step 3
refused "low: --time .*reach from" $plot high low pressure --beside --time 6us
refused "no directory nowhere" $plot low nowhere pressure --beside
refused "with --beside" $plot low high pressure
[ -z "$(ls -d -- *_frames_* film* 2>/dev/null)" ] || fail "something is left"
