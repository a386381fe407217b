/*
 * Parts of expressions, as they are written, that are no finite numbers: simplified formulas of C may lack them. Does
 * what runtime/language/defined.py and runtime/model/written.py do.
 */
const argumentsOf = (tree) => (tree[0] === "curve" ? [tree[2]] : tree.slice(1));

function namesOf(tree) {
    if (!Array.isArray(tree)) return typeof tree === "string" ? [tree] : [];
    return argumentsOf(tree).flatMap(namesOf);
}

/* The argument by which an operator or a function divides. */
function divisorOf(tree, divides) {
    return tree[0] === "/" || divides.includes(tree[0]) ? tree.length - 2 : -1;
}

/* The largest parts that known names alone determine, and 1 over each of them that divides. */
function constantParts(tree, known, divides) {
    if (namesOf(tree).every((name) => Object.hasOwn(known, name))) return [tree];
    if (!Array.isArray(tree)) return [];
    const divisor = divisorOf(tree, divides);
    return argumentsOf(tree).flatMap((argument, k) => constantParts(argument, known, divides)
        .map((part) => (k === divisor && part === argument ? ["/", 1, part] : part)));
}

/* The parts of a constant whose infinity or NaN its value may lack; of a `where` those of the branch that holds. */
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

/* The value of the first part that known names alone determine and that is not finite; undefined: there is none. */
function undefinedPart(tree, known, divides) {
    return constantParts(tree, known, divides)
        .flatMap((part) => [part, ...absorbedParts(part, known, divides)])
        .map((part) => valueOf(part, (name) => known[name])).find((value) => !Number.isFinite(value));
}
