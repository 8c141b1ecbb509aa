// Checks WGSL with Tint: reads a JSON request {"text"} per line, writes a JSON answer {"messages"}.
// Dawn's null backend needs no driver. The first argument is the folder that holds node_modules.

import { createRequire } from "node:module";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";

const require = createRequire(`${process.argv[2]}/`);
const { create } = await import(pathToFileURL(require.resolve("webgpu")).href);
// Dawn aborts if its root object is collected while a device exists, so it is kept forever.
globalThis.gpu = create(["backend=null"]);
const adapter = await globalThis.gpu.requestAdapter();
const device = await adapter.requestDevice();

async function check(text) {
  device.pushErrorScope("validation");
  const info = await device.createShaderModule({ code: text }).getCompilationInfo();
  const error = await device.popErrorScope();
  const messages = info.messages.map((message) => ({
    type: message.type,
    line: message.lineNum,
    column: message.linePos,
    text: message.message,
  }));
  // Dawn checks a little more than Tint does; such an error names no place in the text.
  if (error && !messages.some((message) => message.type === "error")) {
    messages.push({ type: "error", line: 0, column: 0, text: error.message });
  }
  return { messages };
}

for await (const line of createInterface({ input: process.stdin })) {
  process.stdout.write(`${JSON.stringify(await check(JSON.parse(line).text))}\n`);
}
process.exit(0);
