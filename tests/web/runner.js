/* Run the simulations that a test requests with a loaded simulator, and print their results as JSON. */

/* Return an array of doubles as base64, so that every bit arrives. */
function encodeArray(array) {
    const bytes = new Uint8Array(Float64Array.from(array).buffer);
    return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
}

/* Return the results of a run for JSON: stored arrays, units of all series, and the series `names`. */
function describeRun(run, names = []) {
    const stored = ["t", "q", "v", "work", "state", "memory"];
    return {
        arrays: Object.fromEntries(stored.map((name) => [name, encodeArray(run[name])])),
        series: Object.fromEntries(names.map((name) => [name, encodeArray(run.series(name))])),
        units: Object.fromEntries(run.names.map((name) => [name, run.unit(name)])),
        events: run.events, impacts: run.impacts, counts: run.counts,
        isContinued: run.isContinued,
    };
}

/* Run each of [{parameters, options, names, slices}], and return results or errors; slices: with yielded fractions. */
function runAll(sim, runs) {
    return runs.map(({parameters = {}, options, names, slices}) => {
        try {
            sim.setParameters(parameters);
            const fractions = slices ? [...sim.running(options)] : [];
            return {...describeRun(sim.run(options), names), fractions};
        } catch (error) {
            return {error: error.message, partial: error.partial ? describeRun(error.partial) : null};
        }
    });
}

if (typeof require !== "undefined") {
    const fs = require("fs"), request = JSON.parse(fs.readFileSync(0, "utf-8")), {load} = require(request.script);
    load(fs.readFileSync(request.description, "utf-8"), fs.readFileSync(request.module))
        .then((sim) => console.log(JSON.stringify(runAll(sim, request.runs))));
}
