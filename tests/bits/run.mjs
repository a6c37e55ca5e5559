// Prints the report of the module that is named on the command line.
import { readFileSync } from "node:fs";

const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]));
const { memory, report } = instance.exports;
const text = report();
const [address, length] = new Uint32Array(memory.buffer, text, 2);
process.stdout.write(Buffer.from(memory.buffer, address, length));
