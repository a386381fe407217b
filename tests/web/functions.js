/*
 * Call `values` of functions.c on arrays from a file, and write the results to another: functions.js WASM IN OUT.
 *
 * IN contains the doubles x and then y; OUT gets the results of each function, one after the other.
 */
const fs = require("fs"), [wasm, input, output] = process.argv.slice(2);
WebAssembly.instantiate(fs.readFileSync(wasm), {}).then(({instance: {exports: lib}}) => {
    const bytes = fs.readFileSync(input), n = bytes.length / 16, x = lib.malloc(3 * 8 * n), out = [];
    for (let which = 0; which < 6; which++) {
        new Uint8Array(lib.memory.buffer, x, bytes.length).set(bytes);
        lib.values(which, n, x, x + 8 * n, x + 16 * n);
        out.push(Buffer.from(lib.memory.buffer.slice(x + 16 * n, x + 24 * n)));
    }
    fs.writeFileSync(output, Buffer.concat(out));
});
