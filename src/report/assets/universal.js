// The universal fragility surface: the same arithmetic as src/fragility/universal.rs, from the same file.
const universal = (() => {
  const Z_95 = 1.959963984540054;
  const NAMES = ["im4", "im3", "im5", "p", "alpha", "eta"];

  /** The surface in data/universal.csv: knots, domain, spreads and terms. */
  const parse = (text) => {
    const surface = { knots: [], domain: {}, spread: {}, terms: { pro: [], pex: [] } };
    for (const line of text.split("\n").filter((line) => line && !line.startsWith("#"))) {
      const [kind, name, ...cells] = line.split(",");
      const numbers = cells.map(Number);
      if (kind === "domain") surface.domain[name] = numbers;
      if (kind === "knots") surface.knots.push(numbers);
      if (kind === "spread") surface.spread[name] = numbers[0];
      if (kind === "term") surface.terms[name].push({ functions: numbers.slice(0, 8), b: numbers[8], deviations: numbers.slice(9) });
    }
    return surface;
  };

  /** 1, the coordinate, and the cubic functions over its knots. */
  const splines = (u, knots) => [1, u, ...fragility.bends(u, knots)];

  const logistic = (index) => 1 / (1 + Math.exp(-index));

  const probability = (terms, spread, functions) => {
    const deviations = new Array(terms[0].deviations.length).fill(0);
    let index = 0;
    for (const term of terms) {
      const product = term.functions.reduce((product, at, k) => product * (functions[k][at] ?? 0), 1);
      if (product === 0) continue;
      index += term.b * product;
      term.deviations.forEach((deviation, k) => (deviations[k] += deviation * product));
    }
    const squares = deviations.reduce((sum, deviation) => sum + deviation * deviation, 0);
    const half = Z_95 * Math.sqrt(squares / deviations.length + spread * spread);
    return { value: logistic(index), low: logistic(index - half), high: logistic(index + half) };
  };

  const exact = (value) => ({ value, low: value, high: value });

  /** P_nr, P_ex, P_ro, P_f|r and P_f of a structure; null where they do not exist or the ground has no velocity. */
  const evaluate = (surface, { p, alpha, eta }, { limit, motions }, of) => {
    const rocks = of.im4 >= 1;
    const answer = { p_nr: exact(rocks ? 0 : 1), p_ex: null, p_ro: null, p_f_r: null, p_f: rocks ? null : exact(0) };
    if (!rocks || !(of.im3 > 0)) return answer;
    const coordinates = [
      Math.log(Math.log(of.im4) + 0.05), Math.log(of.im3), (eta - 0.85) / 0.1, Math.log(alpha / 0.15), Math.log(p / 2),
      Math.log(limit / 0.2), motions === "pulse" ? 1 : 0, motions === "hfc" ? 1 : 0,
    ];
    const functions = coordinates.map((u, k) => splines(u, surface.knots[k]));
    const [p_ro, p_ex] = ["pro", "pex"].map((name) => probability(surface.terms[name], surface.spread[name], functions));
    const either = (end) => p_ro[end] + (1 - p_ro[end]) * p_ex[end];
    const p_f_r = { value: either("value"), low: either("low"), high: either("high") };
    return { ...answer, p_ex, p_ro, p_f_r, p_f: p_f_r };
  };

  /** What lies outside of its domain. */
  const outOfRange = (surface, structure, of) => {
    const known = { ...of, ...structure };
    const found = NAMES.map((name) => ({ name, value: known[name], least: surface.domain[name][0], largest: surface.domain[name][1] }));
    return of.im4 >= 1 ? found.filter(({ value, least, largest }) => value < least || value > largest) : [];
  };

  return { parse, evaluate, outOfRange };
})();
