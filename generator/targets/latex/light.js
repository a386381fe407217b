/*
 * Highlight related parts of a page of equations together. An element belongs to the tokens of its data-of; selecting
 * it lights all that share one with its data-pick, or else with its data-of. A row's token stands for the row's entries
 * too, a name's for the entries of all terms that have the name, and for the lines that sum their rows.
 */
const gudgeonLight = (() => {
    const LISTED = 400; // lines of C that the panel shows at most
    const files = {};
    let wanted = new Set(), chosen = null;

    const tokensOf = (text) => (text ?? "").split(" ").filter(Boolean);
    const rowOf = (token) => (token.startsWith("entry-") ? `row-${token.split("-")[1]}` : token);
    const isLit = (of) => tokensOf(of).some((token) => wanted.has(token) || wanted.has(rowOf(token)));

    /* A token; of a name the entries of Φ_q of its terms too, and the sums that these stand in. */
    function named(token) {
        if (!token.startsWith("name-")) return [token];
        const terms = [...document.querySelectorAll(`.equation [data-of~="${CSS.escape(token)}"]`)];
        const entries = terms.flatMap((one) => tokensOf(one.dataset.of)).filter((one) => one.startsWith("entry-"));
        return [token, ...entries, ...entries.map((one) => `sum-${one.split("-")[1]}`)];
    }

    /* Lights what shares a token with `tokens`; none put all out. */
    function light(tokens, element = null) {
        wanted = new Set(tokens.flatMap(named));
        chosen?.setAttribute("aria-pressed", false);
        chosen = wanted.size ? element : null;
        chosen?.setAttribute("aria-pressed", true);
        for (const one of document.querySelectorAll("[data-of]")) one.classList.toggle("lit", isLit(one.dataset.of));
        showLines();
        document.dispatchEvent(new CustomEvent("gudgeon:lit", {detail: {tokens: [...wanted]}}));
    }

    function select(element) {
        if (element === chosen) light([]);
        else light(tokensOf(element.dataset.pick ?? element.dataset.of), element);
    }

    /* Lit lines of the mechanism's own file, which stands on the page. */
    function ownLines() {
        return [...document.querySelectorAll(".listing > .lit:not([data-c])")].map((line) => ({
            name: line.closest("details").querySelector("summary").textContent, of: line.dataset.of,
            number: [...line.parentNode.children].indexOf(line) + 1, text: line.textContent}));
    }

    /* The panel at the foot of the page: lit lines of the file, and of C with their values. */
    function showLines() {
        const panel = document.getElementById("gudgeon-lines"), found = [];
        for (const [name, {lines, of, values}] of Object.entries(files))
            for (const [k, own] of of.entries())
                if (isLit(own)) found.push({name, number: k + 1, text: lines[k], value: values[k], of: own});
        const written = found.length ? ownLines() : [];
        panel.hidden = !found.length;
        const pre = panel.querySelector("pre");
        pre.replaceChildren(...[...written, ...found.slice(0, LISTED)].map(asLine));
        const more = found.length > LISTED ? `, of which ${LISTED} are shown` : "";
        const idle = found.some(({value}) => /^law\.|[<>]/.test(value)) ? "; \u2013: not run at this time" : "";
        panel.querySelector("p").textContent =
            `${found.length} ${found.length === 1 ? "line" : "lines"} of C${more}${written.length ? `, ${written.length} of ${written[0].name}` : ""}${idle}. Escape puts the light out.`;
    }

    /* What a line of C stores to, as listings.py reads it. */
    function storedIn(text) {
        const words = text.split(" = ")[0].replace(/ \+$/, "").trim().split(" ");
        return words.at(-1).replaceAll("->", ".").replace(/^\*/, "");
    }

    /* A line of C with its number, its value where it has one, and its tokens. */
    function asLine({name, number, text, value, of}) {
        const line = document.createElement("span");
        line.className = "line";
        line.dataset.place = name ? `${name}:${number}` : number;
        line.textContent = text || " ";
        if (value) {
            const shown = document.createElement("output");
            shown.dataset.value = `tmp.${value.endsWith(".") ? value + storedIn(text) : value}`;
            line.append(shown);
        }
        if (of) Object.assign(line.dataset, {of, c: name});
        if (of) line.tabIndex = -1;
        return line;
    }

    /* A folded listing of each file, filled when it is first unfolded. */
    function list(name, {lines, of, values}) {
        const details = document.createElement("details"), summary = document.createElement("summary");
        const pre = document.createElement("pre");
        pre.className = "listing";
        summary.textContent = `${name}, ${lines.length} lines`;
        details.append(summary, pre);
        details.addEventListener("toggle", () => {
            if (pre.childNodes.length) return;
            const token = (k) => [`c-${name}-${k + 1}`, of[k]].filter(Boolean).join(" ");
            pre.append(...lines.map((text, i) =>
                asLine({name: "", number: i + 1, text, value: values[i], of: of[i] && token(i)})));
            for (const line of pre.children) if (isLit(line.dataset.of)) line.classList.add("lit");
            document.dispatchEvent(new CustomEvent("gudgeon:listed"));
        });
        return details;
    }

    async function unpack(text) {
        const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
        const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
        return JSON.parse(await new Response(plain).text());
    }

    /* To the next or previous part that can be selected. */
    function step(from, by) {
        const all = [...document.querySelectorAll("[data-of]")].filter((one) => one.getClientRects().length);
        const next = all[all.indexOf(from) + by];
        if (next) {
            if (!next.hasAttribute("tabindex")) next.setAttribute("tabindex", "-1");
            next.focus();
        }
    }

    function pressed(event) {
        const element = event.target.closest?.("[data-of]");
        const keys = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1};
        if (event.key === "Escape") light([]);
        else if (!element || event.altKey || event.ctrlKey || event.metaKey) return;
        else if (event.key === "Enter" || event.key === " ") select(element);
        else if (keys[event.key]) step(element, keys[event.key]);
        else return;
        if (event.key !== "Escape") event.preventDefault();
    }

    async function begin() {
        document.addEventListener("click", (event) => {
            const element = event.target.closest("[data-of]");
            if (element && !getSelection().toString()) select(element);
        });
        document.addEventListener("keydown", pressed);
        for (const one of document.querySelectorAll('[data-of][tabindex="0"]')) {
            one.setAttribute("role", "button");
            one.setAttribute("aria-pressed", one === chosen);
        }
        const carried = document.getElementById("gudgeon-c");
        if (!carried) return;
        const {texts, of, values, equations} = await unpack(carried.textContent);
        for (const [name, text] of Object.entries(texts))
            files[name] = {lines: text.replace(/\n$/, "").split("\n"), of: of[name], values: values[name]};
        if (equations) gudgeonValues.take(new Function(`${equations}return gudgeonEquations;`)());
        document.getElementById("gudgeon-c-files").append(...Object.entries(files).map(([name, own]) => list(name, own)));
        if (wanted.size) showLines();
    }
    if (typeof document !== "undefined") addEventListener("DOMContentLoaded", begin);
    return {light, select, isLit, get files() { return files; }};
})();
