// llama.cpp behind the chat completions of OpenAI, for tests: one model, one request at a time.
//
// node server.mjs MODEL.gguf, with SIMWORLD_MODEL_SERVER naming the folder that ci/model-server made. It prints its port as
// the first line, and ends when its standard input does, so that it never outlives the test that started it.
import http from "node:http";
import path from "node:path";
import {pathToFileURL} from "node:url";

const library = path.join(process.env.SIMWORLD_MODEL_SERVER, "node_modules", "node-llama-cpp", "dist", "index.js");
const {getLlama, LlamaCompletion} = await import(pathToFileURL(library));

const llama = await getLlama({
    gpu: false, build: "never", skipDownload: true, maxThreads: 1, logLevel: "error", progressLogs: false,
});
const model = await llama.loadModel({modelPath: process.argv[2]});
// Room for the prompts of planners, which this model's small vocabulary spells almost letter by letter.
const context = await model.createContext({contextSize: 32768, threads: 1});
const sequence = context.getSequence();
const completion = new LlamaCompletion({contextSequence: sequence});

class Refusal extends Error {
    constructor(status, message) {
        super(message);
        this.status = status;
    }
}

const TYPES = ["object", "array", "string", "integer", "number", "boolean", "null"];

function checkSchema(schema, where) {
    if (typeof schema !== "object" || schema === null) throw new Refusal(400, `${where} is no schema`);
    if ("enum" in schema || "const" in schema || "$ref" in schema) return;
    if (Array.isArray(schema.oneOf)) return schema.oneOf.forEach((one, index) => checkSchema(one, `${where}/oneOf/${index}`));
    if (!TYPES.includes(schema.type)) throw new Refusal(400, `${where} has the unknown type ${JSON.stringify(schema.type)}`);
    for (const [name, member] of Object.entries(schema.$defs ?? {})) checkSchema(member, `${where}/$defs/${name}`);
    for (const [name, member] of Object.entries(schema.properties ?? {})) checkSchema(member, `${where}/${name}`);
    if (schema.items) checkSchema(schema.items, `${where}/items`);
}

// The library knows branches by the name of oneOf alone; servers of OpenAI and of llama.cpp know anyOf too.
function branchesRenamed(schema) {
    if (Array.isArray(schema)) return schema.map(branchesRenamed);
    if (typeof schema !== "object" || schema === null) return schema;
    const rename = ([name, member]) => [name === "anyOf" && Array.isArray(member) ? "oneOf" : name, branchesRenamed(member)];
    return Object.fromEntries(Object.entries(schema).map(rename));
}

async function grammarOf(asked) {
    const schema = branchesRenamed(asked);
    checkSchema(schema, "schema");
    try {
        return await llama.createGrammarForJsonSchema(schema);
    } catch (error) {
        throw new Refusal(400, `the schema makes no grammar: ${error.message}`);
    }
}

function textOf(message) {
    if (Array.isArray(message.content)) {
        return message.content.map((part) => {
            if (part.type !== "text") throw new Refusal(400, `this model does not take ${part.type}`);
            return part.text;
        }).join("\n");
    }
    const calls = (message.tool_calls ?? []).map((call) => `${call.function.name}(${call.function.arguments})`);
    return [message.content ?? "", ...calls].join("\n");
}

function read(body) {
    let asked;
    try {
        asked = JSON.parse(body);
    } catch (error) {
        throw new Refusal(400, `the request is no JSON: ${error.message}`);
    }
    if (asked.model !== "random") throw new Refusal(404, `there is no model ${JSON.stringify(asked.model)}`);
    if (!Array.isArray(asked.messages) || asked.messages.length === 0) throw new Refusal(400, "there are no messages");
    const prompt = asked.messages.map((message) => `${message.role}: ${textOf(message)}\n`).join("") + "assistant:";
    return {asked, tokens: model.tokenize(prompt)};
}

function callSchema(tools) {
    return {oneOf: tools.map((tool) => ({
        type: "object",
        properties: {name: {const: tool.function.name}, arguments: tool.function.parameters},
        required: ["name", "arguments"],
        additionalProperties: false,
    }))};
}

async function answer(request, response, body) {
    const {asked, tokens} = read(body);
    const calls = Array.isArray(asked.tools) && asked.tool_choice === "required";
    const schema = calls ? callSchema(asked.tools) : asked.response_format?.json_schema?.schema;
    const grammar = schema && await grammarOf(schema);
    const gone = new AbortController();
    response.on("close", () => gone.abort());
    const piece = (delta, finish_reason = null) => ({
        id: "chat", object: "chat.completion.chunk", model: asked.model, choices: [{index: 0, delta, finish_reason}],
    });
    const send = (event) => response.write(`data: ${JSON.stringify(event)}\n\n`);
    const streams = asked.stream === true;
    if (streams) {
        response.writeHead(200, {"content-type": "text/event-stream"});
        send(piece({role: "assistant", content: ""}));
    }
    let made = 0;
    let sent = "";
    await sequence.clearHistory();
    const {response: text, metadata} = await completion.generateCompletionWithMeta(tokens, {
        maxTokens: asked.max_tokens ?? 256,
        temperature: asked.temperature ?? 0.8,
        seed: asked.seed,
        grammar,
        // the grammars of this library end in four line ends
        customStopTriggers: grammar ? ["\n\n\n\n"] : asked.stop,
        signal: gone.signal,
        stopOnAbortSignal: true,
        onToken: (some) => { made += some.length; },
        onTextChunk: (chunk) => {
            if (streams && !calls) {
                send(piece({content: chunk}));
                sent += chunk;
            }
        },
    });
    const finish = metadata.stopReason === "maxTokens" ? "length" : calls ? "tool_calls" : "stop";
    const usage = {prompt_tokens: tokens.length, completion_tokens: made, total_tokens: tokens.length + made};
    const message = {role: "assistant", content: text};
    if (calls && finish === "tool_calls") {
        const call = JSON.parse(text);
        message.content = null;
        message.tool_calls = [{
            index: 0, id: "call", type: "function",
            function: {name: call.name, arguments: JSON.stringify(call.arguments)},
        }];
    }
    if (!streams) {
        const whole = {id: "chat", object: "chat.completion", model: asked.model, choices: [{index: 0, message, finish_reason: finish}], usage};
        response.writeHead(200, {"content-type": "application/json"}).end(JSON.stringify(whole));
        return;
    }
    if (text.startsWith(sent) && text.length > sent.length && !calls) send(piece({content: text.slice(sent.length)}));
    if (message.tool_calls) send(piece({tool_calls: message.tool_calls}));
    send(piece({}, finish));
    if (asked.stream_options?.include_usage) send({choices: [], usage});
    response.end("data: [DONE]\n\n");
}

let last = Promise.resolve();
const server = http.createServer((request, response) => {
    const fail = (status, message) => {
        if (response.headersSent) return response.destroy();
        response.writeHead(status, {"content-type": "application/json"}).end(JSON.stringify({error: {message, code: status}}));
    };
    if (request.method !== "POST" || request.url !== "/v1/chat/completions") return fail(404, "no such page");
    let body = "";
    request.setEncoding("utf8").on("data", (chunk) => { body += chunk; }).on("end", () => {
        last = last.then(() => answer(request, response, body)).catch((error) => fail(error.status ?? 500, error.message));
    });
});
server.listen(0, "127.0.0.1", () => console.log(server.address().port));
process.stdin.on("end", () => process.exit(0)).resume();
