/*
 * Score the results of the site's search (html_search_scorer of Sphinx).
 *
 * The values are Sphinx's own. Pages for contributors come after the others, unless the query is half of a title or
 * more. Each result is [page, title, anchor, description, score, file name, kind].
 */
var Scorer = {
  score: ([page, , , , score, , kind]) =>
    kind !== "title" && /^(recipes\/|map$|changes$|contributing$|architecture$)/.test(page) ? score - 40 : score,
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
