/*
 * Highlight related parts of a page of equations together.
 *
 * data-of of an element contains its tokens. Selecting an element highlights all elements that share a token with its
 * data-pick, or without one with its data-of. A row's token stands for the row's entries too. The token of a named term
 * stands also for the entries of Φ_q that contain the term, and for the lines that sum their rows.
 */
const gudgeonHighlighting = (() => {
    const MAX_LINES = 400; // lines of C that the panel shows
    const files = {}; // {lines, tokens, valueNames} by name of a C file, each a list with an item per line
    let selectedTokens = new Set(), selected = null;

    const queryAll = (selector) => [...document.querySelectorAll(selector)];
    const splitTokens = (text) => (text ?? "").split(" ").filter(Boolean);
    const getRowToken = (token) => (token.startsWith("entry-") ? `row-${token.split("-")[1]}` : token);

    /* Return whether an element with these tokens, a text, is highlighted. */
    const isHighlighted = (tokens) => splitTokens(tokens).some((token) =>
        selectedTokens.has(token) || selectedTokens.has(getRowToken(token)));

    /* Return a token and those that it stands for: of a named term its entries of Φ_q, and the sums of their rows. */
    function expandToken(token) {
        if (!token.startsWith("name-")) return [token];
        const terms = queryAll(`.equation [data-of~="${CSS.escape(token)}"]`);
        const entries = terms.flatMap((term) => splitTokens(term.dataset.of)).filter((one) => one.startsWith("entry-"));
        return [token, ...entries, ...entries.map((entry) => `sum-${entry.split("-")[1]}`)];
    }

    /* Highlight all elements that share one of these tokens; none if the list is empty. element: the selected one. */
    function highlight(tokens, element = null) {
        selectedTokens = new Set(tokens.flatMap(expandToken));
        selected?.setAttribute("aria-pressed", false);
        selected = selectedTokens.size ? element : null;
        selected?.setAttribute("aria-pressed", true);
        for (const one of queryAll("[data-of]"))
            one.classList.toggle("highlighted", isHighlighted(one.dataset.of));
        showLines();
        document.dispatchEvent(new Event("gudgeon:highlighted"));
    }

    /* Select an element and highlight all that is related to it; a selected element is deselected. */
    function select(element) {
        if (element === selected) highlight([]);
        else highlight(splitTokens(element.dataset.pick ?? element.dataset.of), element);
    }

    /* Return the highlighted lines of the mechanism's own file, which is listed on the page. */
    function listMechanismLines() {
        return queryAll(".listing > .highlighted:not([data-c])").map((line) => ({
            name: line.closest("details").querySelector("summary").textContent, tokens: line.dataset.of,
            number: [...line.parentNode.children].indexOf(line) + 1, text: line.textContent}));
    }

    /* Show the highlighted lines of the mechanism's file, and of C with their values, at the foot of the page. */
    function showLines() {
        const panel = document.getElementById("gudgeon-lines"), found = [];
        for (const [name, {lines, tokens, valueNames}] of Object.entries(files))
            for (const [k, own] of tokens.entries())
                if (isHighlighted(own))
                    found.push({name, number: k + 1, text: lines[k], valueName: valueNames[k], tokens: own});
        const ofMechanism = found.length ? listMechanismLines() : [];
        panel.hidden = !found.length;
        const pre = panel.querySelector("pre");
        pre.replaceChildren(...[...ofMechanism, ...found.slice(0, MAX_LINES)].map(createLine));
        const count = `${found.length} ${found.length === 1 ? "line" : "lines"} of C`;
        const more = found.length > MAX_LINES ? `, of which ${MAX_LINES} are shown` : "";
        const also = ofMechanism.length ? `, ${ofMechanism.length} of ${ofMechanism[0].name}` : "";
        const hasBranches = found.some(({valueName}) => /^law\.|[<>]/.test(valueName));
        const legend = hasBranches ? "; –: not run at this time" : "";
        panel.querySelector("p").textContent = `${count}${more}${also}${legend}. Escape ends the highlighting.`;
    }

    /* Return the name that a line of C stores to, without `->` and `*`, as listings.py reads it. */
    function parseTarget(text) {
        const words = text.split(" = ")[0].replace(/ \+$/, "").trim().split(" ");
        return words.at(-1).replaceAll("->", ".").replace(/^\*/, "");
    }

    /* Create the element of a line with its number, its value if it has one, and its tokens. name: its file, or "". */
    function createLine({name, number, text, valueName, tokens}) {
        const line = document.createElement("span");
        line.className = "line";
        line.dataset.location = name ? `${name}:${number}` : number;
        line.textContent = text || " ";
        if (valueName) {
            const output = document.createElement("output");
            output.dataset.value = `tmp.${valueName.endsWith(".") ? valueName + parseTarget(text) : valueName}`;
            line.append(output);
        }
        if (tokens) Object.assign(line.dataset, {of: tokens, c: name});
        if (tokens) line.tabIndex = -1;
        return line;
    }

    /* Create the folded listing of a C file, which is filled when it is first unfolded. */
    function createListing(name, {lines, tokens, valueNames}) {
        const details = document.createElement("details"), summary = document.createElement("summary");
        const pre = document.createElement("pre");
        pre.className = "listing";
        summary.textContent = `${name}, ${lines.length} lines`;
        details.append(summary, pre);
        details.addEventListener("toggle", () => {
            if (pre.childNodes.length) return;
            pre.append(...lines.map((text, i) => createLine({name: "", number: i + 1, text, valueName: valueNames[i],
                tokens: tokens[i] && `c-${name}-${i + 1} ${tokens[i]}`})));
            for (const line of pre.children) if (isHighlighted(line.dataset.of)) line.classList.add("highlighted");
            document.dispatchEvent(new Event("gudgeon:listed"));
        });
        return details;
    }

    /* Return the JSON that a base64 text packed by gzip contains, as a promise. */
    function unpackJson(text) {
        const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
        const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
        return new Response(plain).json();
    }

    /* Move the focus to the next (change 1) or previous (−1) visible element that can be selected. */
    function moveFocus(element, change) {
        const visible = queryAll("[data-of]").filter((one) => one.getClientRects().length);
        const next = visible[visible.indexOf(element) + change];
        if (next) {
            if (!next.hasAttribute("tabindex")) next.setAttribute("tabindex", "-1");
            next.focus();
        }
    }

    /* Handle a key: Escape deselects, Enter and space select, arrows move the focus. */
    function handleKey(event) {
        const element = event.target.closest?.("[data-of]");
        const changes = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1};
        if (event.key === "Escape") highlight([]);
        else if (!element || event.altKey || event.ctrlKey || event.metaKey) return;
        else if (event.key === "Enter" || event.key === " ") select(element);
        else if (changes[event.key]) moveFocus(element, changes[event.key]);
        else return;
        if (event.key !== "Escape") event.preventDefault();
    }

    /* Connect mouse and keyboard, and list the C that the page contains. */
    async function start() {
        document.addEventListener("click", (event) => {
            const element = event.target.closest("[data-of]");
            if (element && !getSelection().toString()) select(element);
        });
        document.addEventListener("keydown", handleKey);
        for (const element of queryAll('[data-of][tabindex="0"]')) {
            element.setAttribute("role", "button");
            element.setAttribute("aria-pressed", element === selected);
        }
        const embedded = document.getElementById("gudgeon-c");
        if (!embedded) return;
        const {texts, of: tokens, values: valueNames, equations} = await unpackJson(embedded.textContent);
        for (const [name, text] of Object.entries(texts)) {
            const lines = text.replace(/\n$/, "").split("\n");
            files[name] = {lines, tokens: tokens[name], valueNames: valueNames[name]};
        }
        if (equations) gudgeonValues.setEquations(new Function(`${equations}return gudgeonEquations;`)());
        const listings = Object.entries(files).map(([name, file]) => createListing(name, file));
        document.getElementById("gudgeon-c-files").append(...listings);
        if (selectedTokens.size) showLines();
    }
    if (typeof document !== "undefined") addEventListener("DOMContentLoaded", start);
    return {highlight, select, isHighlighted};
})();
