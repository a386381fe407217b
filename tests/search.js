/*
 * Search the built site as a browser does, and print the first five pages for each query as JSON.
 *
 * node search.js SITE QUERY ...
 */
const fs = require("fs");
const vm = require("vm");

const [site, ...queries] = process.argv.slice(2);
const read = (name) => fs.readFileSync(`${site}/${name}`, "utf8");
const browser = `
var window = globalThis, document = {getElementById: () => null}, localStorage = {setItem() {}};
var SPHINX_HIGHLIGHT_ENABLED = false, _ready = () => {}, _ = (text) => text;
`;
const search = `
JSON.stringify(${JSON.stringify(queries)}.map((query) =>
    Search._performSearch(...Search._parseQuery(query)).reverse().slice(0, 5).map(([page]) => page)));
`;
const scripts = ["_static/language_data.js", "_static/searchtools.js", "searchindex.js"].map(read);
console.log(vm.runInThisContext([browser, ...scripts, search].join("\n")));
