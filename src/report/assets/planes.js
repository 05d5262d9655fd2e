(() => {
  const canvas = document.getElementById("space");
  if (!canvas) return;
  const context = canvas.getContext("2d");
  const choice = document.getElementById("cloud");
  choice.replaceChildren(...data.planes.map(({ name }, index) => new Option(name, index)));
  const ASIDE = { turn: -0.6, tilt: 0.35 };
  let view = { ...ASIDE };
  let size = 1;
  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const cloud = () => data.planes[choice.value || 0];
  const AXES = ["ln IM4", "ln IM3", "ln EDP"];

  // Each axis of the data from -1 to 1.
  const frame = ({ points }) => [0, 1, 2].map((axis) => {
    const values = points.map((point) => point[axis]);
    const [low, high] = [Math.min(...values), Math.max(...values)];
    return { low, high, middle: (low + high) / 2, half: (high - low) / 2 || 1 };
  });
  // Round numbers from end to end of an axis, five or so.
  const ticks = ({ low, high }) => {
    const rough = (high - low) / 5;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((factor) => factor * power).find((size) => size >= rough);
    const first = Math.ceil(low / step);
    return Array.from({ length: Math.floor(high / step) - first + 1 }, (_, k) => (first + k) * step);
  };
  const scaled = (box, point) => point.map((value, axis) => (value - box[axis].middle) / box[axis].half);

  // The eye turns around the vertical axis of the demand, then tilts.
  const project = ([x, y, z], scale, [width, height]) => {
    const [c, s] = [Math.cos(view.turn), Math.sin(view.turn)];
    const [right, away] = [c * x + s * y, -s * x + c * y];
    const [ct, st] = [Math.cos(view.tilt), Math.sin(view.tilt)];
    return [width / 2 + scale * right, height / 2 - scale * (ct * z + st * away)];
  };

  const draw = () => {
    const of = cloud();
    const box = frame(of);
    const ratio = window.devicePixelRatio || 1;
    const area = [canvas.clientWidth, canvas.clientHeight];
    [canvas.width, canvas.height] = area.map((length) => Math.round(length * ratio));
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, ...area);
    const scale = (size * Math.min(...area)) / 3.4;
    const at = (point) => project(point, scale, area);
    const line = (points) => {
      context.beginPath();
      points.map(at).forEach((place, index) => (index ? context.lineTo(...place) : context.moveTo(...place)));
      context.stroke();
    };
    context.lineWidth = 1;
    context.strokeStyle = colour("--rule");
    for (const [a, b] of [[-1, -1], [-1, 1], [1, -1], [1, 1]]) {
      line([[-1, a, b], [1, a, b]]);
      line([[a, -1, b], [a, 1, b]]);
      line([[a, b, -1], [a, b, 1]]);
    }
    context.globalAlpha = 0.55;
    for (const point of of.points) {
      context.fillStyle = colours[point[0] < of.transition ? 2 : 0];
      const [x, y] = at(scaled(box, point));
      context.fillRect(x - 1, y - 1, 2, 2);
    }
    context.globalAlpha = 1;
    context.strokeStyle = colours[1];
    const [x, y] = box;
    of.sides.forEach(([a, b1, b2], side) => {
      const [from, to] = side ? [of.transition, x.high] : [x.low, of.transition];
      const on = (u, v) => scaled(box, [u, v, a + b1 * u + b2 * v]);
      const STEPS = 8;
      const inside = (point) => Math.abs(point[2]) <= 1.15;
      for (let k = 0; k <= STEPS; k++) {
        const share = k / STEPS;
        const many = [...Array(25).keys()].map((step) => step / 24);
        const along = many.map((t) => on(from + t * (to - from), y.low + share * (y.high - y.low)));
        const across = many.map((t) => on(from + share * (to - from), y.low + t * (y.high - y.low)));
        for (const wire of [along, across]) line(wire.filter(inside).length > 1 ? wire.filter(inside) : []);
      }
    });
    context.fillStyle = colour("--ink");
    context.font = "14px 'Fira Sans', sans-serif";
    context.textAlign = "center";
    // Each axis is named at an edge of the box that has nothing before it: below, below and on the left.
    const best = (edges, better) => edges.map((edge) => [edge, at(edge)]).reduce((a, b) => (better(b[1], a[1]) ? b : a))[0];
    const lower = (a, b) => a[1] > b[1];
    const edges = [
      best([[0, -1, -1], [0, 1, -1], [0, -1, 1], [0, 1, 1]], lower),
      best([[-1, 0, -1], [1, 0, -1], [-1, 0, 1], [1, 0, 1]], lower),
      best([[-1, -1, 0], [-1, 1, 0], [1, -1, 0], [1, 1, 0]], (a, b) => a[0] < b[0]),
    ];
    edges.forEach((edge, axis) => {
      const [left, top] = at(edge);
      const [right, down] = axis < 2 ? [0, 34] : [-58, 0];
      context.font = "14px 'Fira Sans', sans-serif";
      context.fillText(AXES[axis], left + right, top + down);
      context.font = "12px 'Fira Sans', sans-serif";
      context.strokeStyle = colour("--ink");
      for (const value of ticks(box[axis])) {
        const point = [...edge];
        point[axis] = (value - box[axis].middle) / box[axis].half;
        const [x, y] = at(point);
        const [aside, below] = axis < 2 ? [0, 16] : [-20, 4];
        context.beginPath();
        context.arc(x, y, 1.5, 0, 2 * Math.PI);
        context.stroke();
        context.fillText(String(Number(value.toPrecision(3))).replace("-", "−"), x + aside, y + below);
      }
    });
  };
  let colours = [];
  const recolour = () => {
    colours = [0, 1, 2].map((index) => colour(`--data${index}`));
    draw();
  };

  // Along the line in which both planes meet: turn and tilt that put it into the line of sight.
  const edgeOn = () => {
    const of = cloud();
    const box = frame(of);
    const normal = ([, b1, b2]) => [b1 * box[0].half, b2 * box[1].half, -box[2].half];
    const [m, n] = of.sides.map(normal);
    let [x, y, z] = [m[1] * n[2] - m[2] * n[1], m[2] * n[0] - m[0] * n[2], m[0] * n[1] - m[1] * n[0]];
    if (y < 0) [x, y, z] = [-x, -y, -z];
    view = { turn: Math.atan2(-x, y), tilt: -Math.atan2(z, Math.hypot(x, y)) };
    draw();
  };

  const turn = (right, up) => {
    view.turn += right;
    view.tilt = Math.max(-1.5, Math.min(1.5, view.tilt + up));
    draw();
  };
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    if (canvas.hasPointerCapture(event.pointerId)) turn(event.movementX * 0.01, event.movementY * 0.01);
  });
  canvas.addEventListener("keydown", (event) => {
    const turns = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
    const sizes = { "+": 1.1, "-": 1 / 1.1 };
    if (turns[event.key]) turn(...turns[event.key]);
    else if (sizes[event.key]) {
      size *= sizes[event.key];
      draw();
    } else return;
    event.preventDefault();
  });
  document.getElementById("edge-on").addEventListener("click", edgeOn);
  document.getElementById("from-above").addEventListener("click", () => {
    view = { ...ASIDE };
    size = 1;
    draw();
  });
  choice.addEventListener("change", draw);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", recolour);
  new ResizeObserver(recolour).observe(canvas);
})();
