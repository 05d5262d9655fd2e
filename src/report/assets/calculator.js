const data = JSON.parse(document.getElementById("data").textContent);

(() => {
  if (!document.getElementById("calculator")) return;
  const field = (id) => document.getElementById(id);
  const number = (id) => (field(id).value === "" ? NaN : Number(field(id).value));
  const ROWS = [
    ["p_nr", "P<sub>nr</sub>", "no rocking"],
    ["p_ex", "P<sub>ex</sub>", "a demand above the limit state, in safe rocking"],
    ["p_ro", "P<sub>ro</sub>", "overturning, given rocking"],
    ["p_f_r", "P<sub>f|r</sub>", "failure given rocking: the one or the other"],
    ["p_f", "P<sub>f</sub>", "failure over the whole tree"],
  ];
  const surface = universal.parse(data.surface);
  const NAMES = {
    universal: "universal: the surface for every structure", bivariate: "bivariate: IM4 and IM3, hybrid measure", im1: "IM1: ωp / p", im2: "IM2: ωm / p", im3: "IM3: PGA / (p PGV)",
    im4: "IM4: PGA / (g tan α)", im5: "IM5: p PGV / (g tan α)", im6: "IM6: ωm PGV / (g tan α)",
  };
  const nameOf = ({ suite, structure }) => (suite === null ? structure : `${structure}, ${suite}`);
  const names = [...new Set(data.models.map(nameOf))].sort();
  const option = (value, words) => new Option(words, value);
  field("fit").replaceChildren(...names.map((name) => option(name, name)));

  const modelsOf = (name) => {
    const models = data.models.filter((model) => nameOf(model) === name);
    const [{ suite, structure, limit }] = models;
    return [...models, { suite, structure, form: "universal", limit: Math.min(Math.max(limit, 0.02), 0.5), motions: suite, eta: null, doubt: null }];
  };
  const short = (value) => (value === 0 || value === 1 ? String(value) : value < 1e-4 ? value.toExponential(2) : value.toPrecision(4));

  const chooseFit = () => {
    const models = modelsOf(field("fit").value);
    const before = field("form").value;
    field("form").replaceChildren(...models.map(({ form }) => option(form, NAMES[form])));
    if (models.some(({ form }) => form === before)) field("form").value = before;
    const { p, alpha, eta } = data.structures.find(({ name }) => name === models[0].structure);
    field("p").value = p;
    field("alpha").value = alpha;
    field("eta").value = eta;
    answer();
  };

  const structure = () => {
    if (field("question").elements.by.value === "parameters") return { p: number("p"), alpha: number("alpha") };
    return fragility.block(data.g, number("width"), number("height"));
  };

  const answer = () => {
    const byBlock = field("question").elements.by.value === "block";
    document.querySelectorAll("#question .block").forEach((label) => (label.hidden = !byBlock));
    document.querySelectorAll("#question .parameters").forEach((label) => (label.hidden = byBlock));
    const model = modelsOf(field("fit").value).find(({ form }) => form === field("form").value);
    field("needs-tp").hidden = model.form !== "im1";
    field("needs-tm").hidden = !["im2", "im6"].includes(model.form);
    const { p, alpha } = structure();
    const motion = { pga: number("pga") * data.g, pgv: number("pgv"), tp: number("tp"), tm: number("tm") };
    const warnings = [];
    const given = { ...(byBlock ? { width: number("width"), height: number("height") } : {}), p, alpha, eta: number("eta"), pga: number("pga"), pgv: number("pgv") };
    const refused = data.bounds.filter(({ parameter, range: [least, most] }) => parameter in given && !(given[parameter] >= least && given[parameter] <= most));
    const exchanged = given.width > given.height;
    if (exchanged) warnings.push("The width is larger than the height: were they exchanged?");
    else if (refused.length) {
      const { parameter, expected, slip } = refused[0];
      const value = given[parameter];
      warnings.push(Number.isNaN(value) ? `Expected ${parameter}: ${expected}.` : `${parameter} is ${value}; expected ${expected}${value > 0 ? `; ${slip}` : "."}`);
    }
    const right = !exchanged && !refused.length;
    const doubt = data.doubts.find(({ bounds: [above, below, strongest] }) =>
      (above === null || motion.pgv > above * motion.pga) && (below === null || (motion.pgv > 0 && motion.pgv < below * motion.pga)) &&
      (strongest === null || motion.pga > strongest));
    if (right && doubt) warnings.push(doubt.words);
    const of = fragility.measures(data.g, { p, alpha, ...motion });
    const block = { p, alpha, eta: number("eta") };
    const byFits = model.form !== "universal";
    const answers = !right ? {} : byFits ? fragility.evaluate(model, of) : universal.evaluate(surface, block, model, of);
    if (right && model.doubt) warnings.push(`${model.doubt}.`);
    if (right && answers.p_f === null) warnings.push("The fits need a measure that is missing: give PGV, and the period if there is a field for it, above 0.");
    if (right && byFits && Math.abs(number("eta") - model.eta) > 0.005) {
      warnings.push(`The fits are of η ${model.eta}, on which the curves depend: simulate and fit with this η.`);
    }
    for (const { name, value, least, largest } of !right ? [] : byFits ? fragility.outOfRange(model, of) : universal.outOfRange(surface, block, of)) {
      warnings.push(`${name} is ${value.toPrecision(4)}, outside of ${least.toPrecision(4)} to ${largest.toPrecision(4)} in the data: extrapolated.`);
    }
    const rows = ROWS.map(([key, symbol, words]) => {
      const row = document.createElement("tr");
      row.id = `answer-${key}`;
      const of = answers[key] ?? null;
      const limits = of === null || of.low === of.high ? "–" : `${short(of.low)} to ${short(of.high)}`;
      row.innerHTML = `<th scope="row">${symbol}</th><td class="meaning">${words}</td><td class="number">${of === null ? "–" : short(of.value)}</td><td class="number">${limits}</td>`;
      Object.assign(row.dataset, of ?? {});
      return row;
    });
    document.querySelector("#answers tbody").replaceChildren(...rows);
    field("warnings").replaceChildren(...warnings.map((words) => Object.assign(document.createElement("li"), { textContent: words })));
  };

  field("fit").addEventListener("change", chooseFit);
  field("question").addEventListener("input", answer);
  chooseFit();
})();
