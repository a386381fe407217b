// Runs what a test asks for (JSON on standard input) and prints arrays as base64, so that every bit arrives.
const fs = require("fs");
const asked = JSON.parse(fs.readFileSync(0, "utf-8"));
const gudgeon = require(asked.script);
const bits = (array) => Buffer.from(Float64Array.from(array).buffer).toString("base64");

function told(run, names) {
    const arrays = Object.fromEntries(["t", "q", "v", "work", "state", "memory"].map((name) => [name, bits(run[name])]));
    const series = Object.fromEntries((names ?? []).map((name) => [name, bits(run.series(name))]));
    const units = Object.fromEntries(run.names.map((name) => [name, run.unit(name)]));
    return {arrays, series, units, events: run.events, impacts: run.impacts, counts: run.counts};
}

(async () => {
    const sim = await gudgeon.load(fs.readFileSync(asked.description, "utf-8"), fs.readFileSync(asked.module));
    const answers = asked.runs.map(({parameters, options, names}) => {
        try {
            sim.setParameters(parameters ?? {});
            return told(sim.run(options), names);
        } catch (error) {
            return {error: error.message, partial: error.partial ? told(error.partial) : null};
        }
    });
    console.log(JSON.stringify(answers));
})();
