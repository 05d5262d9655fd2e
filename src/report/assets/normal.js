// The standard normal distribution, by Cody (1969), as in the program.
const normal = (() => {
  const ratio = ([top, bottom], x) => {
    const horner = (coefficients) => coefficients.reduce((sum, coefficient) => sum * x + coefficient, 0);
    return horner(top) / horner(bottom);
  };
  // Highest power first.
  const CENTRE = [
    [1.85777706184603153e-1, 3.16112374387056560, 1.13864154151050156e2, 3.77485237685302021e2, 3.20937758913846947e3],
    [1.0, 2.36012909523441209e1, 2.44024637934444173e2, 1.28261652607737228e3, 2.84423683343917062e3],
  ];
  const FLANK = [
    [2.15311535474403846e-8, 5.64188496988670089e-1, 8.88314979438837594, 6.61191906371416295e1, 2.98635138197400131e2,
      8.81952221241769090e2, 1.71204761263407058e3, 2.05107837782607147e3, 1.23033935479799725e3],
    [1.0, 1.57449261107098347e1, 1.17693950891312499e2, 5.37181101862009858e2, 1.62138957456669019e3,
      3.29079923573345963e3, 4.36261909014324716e3, 3.43936767414372164e3, 1.23033935480374942e3],
  ];
  const TAIL = [
    [1.63153871373020978e-2, 3.05326634961232344e-1, 3.60344899949804439e-1, 1.25781726111229246e-1,
      1.60837851487422766e-2, 6.58749161529837803e-4],
    [1.0, 2.56852019228982242, 1.87295284992346047, 5.27905102951428412e-1, 6.05183413124413191e-2,
      2.33520497626869185e-3],
  ];
  const erfc = (x) => {
    const y = Math.abs(x);
    if (y <= 0.46875) return 1 - x * ratio(CENTRE, y * y);
    const u = 1 / (y * y);
    const scaled = y <= 4 ? ratio(FLANK, y) : (1 / Math.sqrt(Math.PI) - u * ratio(TAIL, u)) / y;
    const tail = y > 27 ? 0 : Math.exp(-y * y) * scaled;
    return x < 0 ? 2 - tail : tail;
  };
  return { cdf: (x) => 0.5 * erfc(-x * Math.SQRT1_2) };
})();
