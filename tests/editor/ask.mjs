// ask.mjs - asks a YAML language server what an editor would show in case files, and judges the answers.
//
//     node ask.mjs SERVER SCHEMA QUESTIONS       (check.sh calls it)
//
// A question of the file QUESTIONS begins with a line `# KIND: title`; KIND is complete, hover or errors. The lines
// up to the answers are the case, with @@ where the cursor is. Then what must be in the answer (`= word`, one or more
// lines), what must not (`! word`); `= none` of errors: no errors at all. The case goes to the server as an editor
// would send it: opened from memory, with the schema in its first line.
import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [server, schema, questionFile] = process.argv.slice(2);
const verbose = process.env.ASK_SHOW === "1";

function readQuestions(text) {
    const questions = [];
    for (const block of text.split(/^# (?=(?:complete|hover|errors): )/m).slice(1)) {
        const [head, ...lines] = block.trimEnd().split("\n");
        const [, kind, title] = head.match(/^(\w+): (.*)$/);
        const answers = lines.filter((line) => /^[=!] /.test(line));
        const body = lines.filter((line) => !/^[=!] /.test(line)).join("\n");
        questions.push({
            kind, title, body,
            wanted: answers.filter((line) => line[0] === "=").map((line) => line.slice(2)),
            unwanted: answers.filter((line) => line[0] === "!").map((line) => line.slice(2)),
        });
    }
    return questions;
}

// The language server protocol: JSON with a Content-Length header over pipes.
class Client {
    constructor(command) {
        this.child = spawn(process.execPath, [command, "--stdio"], { stdio: ["pipe", "pipe", "ignore"] });
        this.child.on("exit", () => console.log("wrong  the server has ended") ?? process.exit(1));
        this.waiting = new Map();
        this.diagnostics = new Map();
        this.count = 0;
        this.buffer = Buffer.alloc(0);
        this.child.stdout.on("data", (bytes) => this.take(bytes));
    }

    take(bytes) {
        this.buffer = Buffer.concat([this.buffer, bytes]);
        for (;;) {
            const end = this.buffer.indexOf("\r\n\r\n");
            if (end < 0) return;
            const length = Number(/Content-Length: (\d+)/i.exec(this.buffer.subarray(0, end))[1]);
            if (this.buffer.length < end + 4 + length) return;
            this.receive(JSON.parse(this.buffer.subarray(end + 4, end + 4 + length)));
            this.buffer = this.buffer.subarray(end + 4 + length);
        }
    }

    receive(message) {
        if (message.method === "textDocument/publishDiagnostics")
            this.diagnostics.get(message.params.uri)?.(message.params.diagnostics);
        else if (message.method && message.id !== undefined)
            this.send({ id: message.id, result: message.method === "workspace/configuration" ? [{}, {}, {}, {}] : null });
        else if (message.id !== undefined) this.waiting.get(message.id)?.(message.result);
    }

    send(message) {
        const body = JSON.stringify({ jsonrpc: "2.0", ...message });
        this.child.stdin.write(`Content-Length: ${Buffer.byteLength(body)}\r\n\r\n${body}`);
    }

    request(method, params) {
        const id = ++this.count;
        this.send({ id, method, params });
        return new Promise((resolve) => this.waiting.set(id, resolve));
    }

    // Opens a text; resolves with its errors.
    open(uri, text) {
        const errors = new Promise((resolve) => this.diagnostics.set(uri, resolve));
        this.send({ method: "textDocument/didOpen", params: { textDocument: { uri, languageId: "yaml", version: 1, text } } });
        return errors;
    }
}

function answerText(kind, answer) {
    if (kind === "complete") return (answer?.items ?? answer ?? []).map((item) => item.label);
    if (kind === "hover") return [JSON.stringify(answer?.contents ?? "")];
    return answer.map((error) => `${error.range.start.line}:${error.range.start.character}: ${error.message}`);
}

async function ask(client, question, number) {
    const modeline = `# yaml-language-server: $schema=${pathToFileURL(schema)}\n`;
    const marked = modeline + question.body;
    const before = marked.split("@@")[0].split("\n");
    const position = { line: before.length - 1, character: before.at(-1).length };
    const uri = `file:///cases/question-${number}.yaml`;
    const errors = await client.open(uri, marked.replace("@@", ""));
    if (question.kind === "errors") return answerText("errors", errors);
    const method = question.kind === "hover" ? "textDocument/hover" : "textDocument/completion";
    return answerText(question.kind, await client.request(method, { textDocument: { uri }, position }));
}

// Of completions the whole label must be there; of hovers and errors a part of the text.
function judge(question, answers) {
    const has = (word) => answers.some((text) => (question.kind === "complete" ? text === word : text.includes(word)));
    const missing = question.wanted.filter((word) => (word === "none" ? answers.length > 0 : !has(word)));
    return [...missing.map((word) => `not there: ${word}`), ...question.unwanted.filter(has).map((word) => `there: ${word}`)];
}

setTimeout(() => {
    console.log("wrong  no answer for two minutes");
    process.exit(1);
}, 120000).unref();
const client = new Client(server);
await client.request("initialize", { processId: process.pid, rootUri: null, capabilities: {} });
client.send({ method: "initialized", params: {} });
client.send({
    method: "workspace/didChangeConfiguration",
    params: { settings: { yaml: { validate: true, hover: true, completion: true, schemaStore: { enable: false } } } },
});
let failed = 0;
const questions = readQuestions(readFileSync(questionFile, "utf8"));
for (const [number, question] of questions.entries()) {
    const answers = await ask(client, question, number);
    const faults = judge(question, answers);
    failed += faults.length > 0;
    console.log(`${faults.length ? "wrong" : "ok"}  ${question.kind}: ${question.title}`);
    if (faults.length || verbose) console.log([...faults, ...answers].map((line) => `       ${line}`).join("\n"));
}
console.log(`${questions.length - failed} of ${questions.length} answers are right`);
client.child.removeAllListeners("exit").kill();
process.exit(failed ? 1 : 0);
