// Runs what a test asks for with a loaded simulator; arrays as base64, so that every bit arrives.
function bits(array) {
    const bytes = new Uint8Array(Float64Array.from(array).buffer);
    return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
}

function told(run, names = []) {
    const stored = ["t", "q", "v", "work", "state", "memory"];
    return {
        arrays: Object.fromEntries(stored.map((name) => [name, bits(run[name])])),
        series: Object.fromEntries(names.map((name) => [name, bits(run.series(name))])),
        units: Object.fromEntries(run.names.map((name) => [name, run.unit(name)])),
        events: run.events, impacts: run.impacts, counts: run.counts,
        followed: run.followed,
    };
}

function answers(sim, runs) {
    return runs.map(({parameters = {}, options, names, slices}) => {
        try {
            sim.setParameters(parameters);
            const shares = slices ? [...sim.running(options)] : [];
            return {...told(sim.run(options), names), shares};
        } catch (error) {
            return {error: error.message, partial: error.partial ? told(error.partial) : null};
        }
    });
}

if (typeof require !== "undefined") {
    const fs = require("fs"), asked = JSON.parse(fs.readFileSync(0, "utf-8")), {load} = require(asked.script);
    load(fs.readFileSync(asked.description, "utf-8"), fs.readFileSync(asked.module))
        .then((sim) => console.log(JSON.stringify(answers(sim, asked.runs))));
}
