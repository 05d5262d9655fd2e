(() => {
  if (!document.getElementById("motions")) return;
  const choice = document.getElementById("motion");
  choice.replaceChildren(...data.motions.map(({ name }, index) => new Option(name, index)));
  choice.value = data.motion;
  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

  // Sixteen bits a value.
  const values = ({ values, unit }) => {
    const bytes = Uint8Array.from(atob(values), (letter) => letter.charCodeAt(0));
    return Array.from(new Int16Array(bytes.buffer), (value) => value * unit);
  };
  const times = ({ step }, count) => Array.from({ length: count }, (_, index) => index * step);

  let plots = [];
  const sync = uPlot.sync("motions");
  const plot = (id, label, series, x, impacts) => {
    const into = document.getElementById(id);
    into.replaceChildren();
    const axis = { stroke: colour("--ink"), grid: { stroke: colour("--rule"), width: 0.5 }, ticks: { stroke: colour("--rule") }, font: "12px 'Fira Sans'", labelFont: "12px 'Fira Sans'" };
    const ticks = (u) => {
      impacts.forEach(({ at, ink, side }) => {
        u.ctx.strokeStyle = ink;
        u.ctx.lineWidth = devicePixelRatio;
        u.ctx.beginPath();
        const zero = u.valToPos(0, "y", true);
        for (const time of at) {
          if (time < u.scales.x.min || time > u.scales.x.max) continue;
          const place = u.valToPos(time, "x", true);
          u.ctx.moveTo(place, zero);
          u.ctx.lineTo(place, zero - side * 7 * devicePixelRatio);
        }
        u.ctx.stroke();
      });
    };
    const options = {
      width: into.clientWidth, height: 190, cursor: { sync: { key: sync.key } }, scales: { x: { time: false } },
      axes: [{ ...axis, label: "time (s)", labelSize: 18, size: 34 }, { ...axis, label, size: 56, labelSize: 18 }],
      series: [{ label: "time (s)", value: (_, v) => (v === null ? "–" : v.toFixed(2)) }, ...series.map(({ words, ink }) => ({ label: words, stroke: ink, width: 1, value: (_, v) => (v === null || v === undefined ? "–" : v.toPrecision(3)) }))],
      hooks: { draw: [ticks] },
    };
    return new uPlot(options, [x, ...series.map(({ of }) => of)], into);
  };

  const show = () => {
    const motion = data.motions[choice.value || 0];
    plots.forEach((old) => old.destroy());
    const ends = motion.traces.map(({ structure, outcome, impacts }) => `${structure}: ${outcome}, ${impacts.length} impacts`);
    document.getElementById("motion-words").textContent = `${motion.name}${motion.words}. ${ends.join("; ")}.`;
    const acceleration = values(motion.acceleration);
    const velocity = values(motion.velocity);
    const rotations = motion.traces.map((trace) => values(trace.theta));
    const longest = Math.max(acceleration.length, ...rotations.map((rotation) => rotation.length));
    // Rotation ends with overturning, so that it may be drawn in finer steps: each on the times of the motion.
    const x = times(motion.acceleration, longest);
    const onTimes = (rotation, { step }) => x.map((time) => {
      const index = Math.round(time / step);
      return index < rotation.length ? rotation[index] : null;
    });
    const inks = motion.traces.map((_, index) => colour(`--data${[0, 1, 2, 3][index % 4]}`));
    plots = [
      plot("plot-acceleration", "acceleration (m/s²)", [{ words: "acceleration", ink: colour("--ink"), of: acceleration }], times(motion.acceleration, acceleration.length), []),
      plot("plot-velocity", "velocity (m/s)", [{ words: "velocity", ink: colour("--ink"), of: velocity }], times(motion.velocity, velocity.length), []),
      plot("plot-rotation", "θ / α", motion.traces.map(({ structure, theta }, index) => ({ words: structure, ink: inks[index], of: onTimes(rotations[index], theta) })), x,
        motion.traces.map(({ impacts }, index) => ({ at: impacts, ink: inks[index], side: index % 2 ? -1 : 1 }))),
    ];
  };
  const step = (by) => {
    choice.selectedIndex = (choice.selectedIndex + by + choice.length) % choice.length;
    show();
  };
  choice.addEventListener("change", show);
  document.getElementById("previous").addEventListener("click", () => step(-1));
  document.getElementById("next").addEventListener("click", () => step(1));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", show);
  let width = 0;
  new ResizeObserver(([{ contentRect }]) => {
    if (contentRect.width !== width) {
      width = contentRect.width;
      plots.forEach((old) => old.setSize({ width, height: 190 }));
    }
  }).observe(document.getElementById("plot-acceleration"));
  document.fonts.ready.then(show);
})();
