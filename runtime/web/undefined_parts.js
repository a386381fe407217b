/*
 * Find parts of the file's expressions that are undefined at given values (runtime/language/undefined_parts.py).
 *
 * Expressions are trees: a number, a name, or [function, ...]. `divides` lists the functions that divide by their last
 * argument; `known` contains the values of known names.
 */

/* Return the arguments of a node. */
const getArguments = (tree) => (tree[0] === "curve" ? [tree[2]] : tree.slice(1));

/* Return all names in an expression. */
function listNames(tree) {
    if (!Array.isArray(tree)) return typeof tree === "string" ? [tree] : [];
    return getArguments(tree).flatMap(listNames);
}

/* Return the index of the argument by which an operator or function divides, otherwise -1. */
function findDivisor(tree, divides) {
    return tree[0] === "/" || divides.includes(tree[0]) ? tree.length - 2 : -1;
}

/* Return the largest parts that depend on known names only; of each divisor 1 over it. */
function listConstantParts(tree, known, divides) {
    if (listNames(tree).every((name) => Object.hasOwn(known, name))) return [tree];
    if (!Array.isArray(tree)) return [];
    const divisor = findDivisor(tree, divides);
    return getArguments(tree).flatMap((argument, k) => listConstantParts(argument, known, divides)
        .map((part) => (k === divisor && part === argument ? ["/", 1, part] : part)));
}

/*
 * Return the parts of a constant expression whose infinity or NaN its value may hide: arguments, divisors, exponents.
 *
 * Of the inactive branch of a `where`, only parts without any parameter are included.
 */
function listMaskedParts(tree, known, divides) {
    if (!Array.isArray(tree)) return [];
    const [head] = tree;
    let parts = getArguments(tree);
    const nested = parts.flatMap((argument) => listMaskedParts(argument, known, divides));
    if (head === "/") return [parts[1], ...nested];
    if (head === "**") return [...parts, ...nested];
    if (head === "+" || head === "-" || head === "*") return nested;
    const reciprocal = divides.includes(head) ? [["/", 1, parts[parts.length - 1]]] : [];
    if (head !== "where") return [...parts, ...reciprocal, ...nested];
    const getValue = (name) => known[name], [less, more] = parts;
    const isLess = evaluateExpression(less, getValue) < evaluateExpression(more, getValue);
    const [active, inactive] = isLess ? [parts[2], parts[3]] : [parts[3], parts[2]];
    parts = [less, more, active, ...listConstantParts(inactive, {}, divides)];
    return [...parts, ...parts.flatMap((argument) => listMaskedParts(argument, known, divides))];
}

/* Return the first value of a known part that is not finite, or undefined. */
function findUndefinedPart(tree, known, divides) {
    return listConstantParts(tree, known, divides)
        .flatMap((part) => [part, ...listMaskedParts(part, known, divides)])
        .map((part) => evaluateExpression(part, (name) => known[name])).find((value) => !Number.isFinite(value));
}
