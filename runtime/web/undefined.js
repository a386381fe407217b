/* Find expressions of the file that are undefined at given parameter values (runtime/language/undefined_parts.py). */

/* Return the arguments of a node. */
const argumentsOf = (tree) => (tree[0] === "curve" ? [tree[2]] : tree.slice(1));

/* Return all names in an expression. */
function namesOf(tree) {
    if (!Array.isArray(tree)) return typeof tree === "string" ? [tree] : [];
    return argumentsOf(tree).flatMap(namesOf);
}

/* Return the index of the argument by which an operator or function divides, otherwise -1. */
function divisorOf(tree, divides) {
    return tree[0] === "/" || divides.includes(tree[0]) ? tree.length - 2 : -1;
}

/* Return the largest parts that depend on known names only, and 1 over each of them that is a divisor. */
function constantParts(tree, known, divides) {
    if (namesOf(tree).every((name) => Object.hasOwn(known, name))) return [tree];
    if (!Array.isArray(tree)) return [];
    const divisor = divisorOf(tree, divides);
    return argumentsOf(tree).flatMap((argument, k) => constantParts(argument, known, divides)
        .map((part) => (k === divisor && part === argument ? ["/", 1, part] : part)));
}

/* Return the parts of a constant whose infinity or NaN may not appear in its value; of a `where` the active branch. */
function absorbedParts(tree, known, divides) {
    if (!Array.isArray(tree)) return [];
    const [head] = tree;
    let rest = argumentsOf(tree);
    const inner = rest.flatMap((argument) => absorbedParts(argument, known, divides));
    if (head === "/") return [rest[1], ...inner];
    if (head === "**") return [...rest, ...inner];
    if (head === "+" || head === "-" || head === "*") return inner;
    const inverse = divides.includes(head) ? [["/", 1, rest[rest.length - 1]]] : [];
    if (head !== "where") return [...rest, ...inverse, ...inner];
    const [less, more] = rest, holds = valueOf(less, (name) => known[name]) < valueOf(more, (name) => known[name]);
    const [chosen, other] = holds ? [rest[2], rest[3]] : [rest[3], rest[2]];
    rest = [less, more, chosen, ...constantParts(other, {}, divides)];
    return [...rest, ...rest.flatMap((argument) => absorbedParts(argument, known, divides))];
}

/* Return the first value of a known part that is not finite, or undefined. */
function undefinedPart(tree, known, divides) {
    return constantParts(tree, known, divides)
        .flatMap((part) => [part, ...absorbedParts(part, known, divides)])
        .map((part) => valueOf(part, (name) => known[name])).find((value) => !Number.isFinite(value));
}
