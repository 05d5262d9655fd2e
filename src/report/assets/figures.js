// Figures: files of them out of the page itself, so that a page that is mailed alone has them; what a point is; and words where
// something is wider than the window.
(() => {
  const numbers = (text) => {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    return new Float32Array(bytes.buffer);
  };
  /** Points of sixteen bits a coordinate, between ends that are logarithms where the axis has them. */
  const cloud = (axes, ends, text) => {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    return Float32Array.from(new Uint16Array(bytes.buffer), (part, k) => {
      const [low, high] = ends[k % 2];
      const value = low + (part / 65535) * (high - low);
      return axes[k % 2].log ? Math.exp(value) : value;
    });
  };
  const digits = (value, count) => (Number.isFinite(value) ? String(Number(value.toPrecision(count))) : "");

  /** All points of a panel: their series, values in the order x, y and further ones. */
  const points = ({ x, y, series }) => series.flatMap(({ name, further, values, ends }) => {
    const [all, width] = [ends ? cloud([x, y], ends, values) : numbers(values), 2 + further.length];
    return Array.from({ length: all.length / width }, (_, k) => ({ name, further, at: all.subarray(k * width, (k + 1) * width) }));
  });
  const place = ({ names }, value, count) => names[Math.round(value)] ?? digits(value, count);

  const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  const csv = ({ panels }) => {
    const rows = [["panel", "series", "x_is", "x", "y_is", "y", "low", "high", "n"]];
    for (const panel of panels) {
      for (const { name, further, at } of points(panel)) {
        const rest = ["low", "high", "n"].map((head) => (further.includes(head) ? digits(at[2 + further.indexOf(head)], 7) : ""));
        rows.push([panel.title, name, panel.x.is, place(panel.x, at[0], further.length ? 7 : 4), panel.y.is, place(panel.y, at[1], further.length ? 7 : 4), ...rest]);
      }
    }
    return `${rows.map((row) => row.map(quoted).join(",")).join("\n")}\n`;
  };

  const element = (name, text) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    made.textContent = text;
    return made;
  };
  /** The figure on white, with its own words; with `fonts` it looks the same where they are missing. */
  const svg = (figure, { title, about }, fonts) => {
    const drawn = figure.querySelector("svg").cloneNode(true);
    const { width, height } = drawn.viewBox.baseVal;
    const paper = element("rect", "");
    for (const [name, value] of [["width", width], ["height", height], ["fill", "#fff"]]) paper.setAttribute(name, value);
    drawn.prepend(element("title", title), element("desc", about), ...(fonts ? [element("style", fonts)] : []), paper);
    for (const name of ["role", "aria-label"]) drawn.removeAttribute(name);
    const about_fonts = { width: `${width}pt`, height: `${height}pt`, "font-family": "Fira Sans, Helvetica Neue, Helvetica, Arial, Liberation Sans, sans-serif", style: "white-space:pre" };
    for (const [name, value] of Object.entries(about_fonts)) drawn.setAttribute(name, value);
    return new XMLSerializer().serializeToString(drawn).replace(/var\((--\w+)\)/g, (_, ink) => data.inks[ink]);
  };
  const png = async (figure, words) => {
    const DOTS_PER_POINT = 300 / 72;
    const picture = new Image();
    picture.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg(figure, words, document.getElementById("fonts").textContent))}`;
    await picture.decode();
    const { width, height } = figure.querySelector("svg").viewBox.baseVal;
    const canvas = Object.assign(document.createElement("canvas"), { width: Math.ceil(width * DOTS_PER_POINT), height: Math.ceil(height * DOTS_PER_POINT) });
    canvas.getContext("2d").drawImage(picture, 0, 0, canvas.width, canvas.height);
    return new Promise((made) => canvas.toBlob(made, "image/png"));
  };
  const blob = async (kind, figure, of) => {
    if (kind === "png") return png(figure, of);
    const [text, type] = kind === "csv" ? [csv(of), "text/csv"] : [svg(figure, of), "image/svg+xml"];
    return new Blob([text], { type });
  };

  const tip = Object.assign(document.createElement("div"), { id: "tip", hidden: true });
  document.querySelector("main").append(tip);
  /** Where a value lies along an axis, from 0 to 1. */
  const share = ({ log, low, high }, value) => (log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low));
  const NEAR = 12;
  const show = (event, drawn, panels) => {
    const box = drawn.getBoundingClientRect();
    const scale = box.width / drawn.viewBox.baseVal.width;
    const [x, y] = [(event.clientX - box.left) / scale, (event.clientY - box.top) / scale];
    let [nearest, found] = [NEAR / scale, null];
    for (const panel of panels) {
      const { corner: [left, top], size: [width, height] } = panel;
      if (x < left - NEAR || x > left + width + NEAR || y < top - NEAR || y > top + height + NEAR) continue;
      panel.points ??= points(panel);
      for (const point of panel.points) {
        const away = Math.hypot(left + width * share(panel.x, point.at[0]) - x, top + height * (1 - share(panel.y, point.at[1])) - y);
        if (away < nearest) [nearest, found] = [away, { panel, point }];
      }
    }
    tip.hidden = !found;
    if (!found) return;
    const { panel, point: { name, further, at } } = found;
    const of = (axis, value) => (axis.names.length ? place(axis, value, 3) : `${axis.is} ${digits(value, 3)}`);
    const rest = further.map((head, k) => [head, at[2 + k]]).filter(([, value]) => Number.isFinite(value)).map(([head, value]) => `${head} ${digits(value, 3)}`);
    tip.textContent = [name, of(panel.x, at[0]), of(panel.y, at[1]), ...rest].join("; ");
    const left = Math.min(event.clientX + 14, innerWidth - tip.offsetWidth - 8);
    Object.assign(tip.style, { left: `${Math.max(8, left) + scrollX}px`, top: `${event.clientY + 16 + scrollY}px` });
  };

  for (const [name, of] of Object.entries(data.figures)) {
    const figure = document.getElementById(`figure-${name}`);
    for (const link of figure.querySelectorAll(".files a")) {
      link.addEventListener("click", async (event) => {
        event.preventDefault();
        const kind = link.download.split(".").pop();
        const url = URL.createObjectURL(await blob(kind, figure, of));
        Object.assign(document.createElement("a"), { href: url, download: link.download }).click();
        setTimeout(() => URL.revokeObjectURL(url), 10000);
      });
    }
    const drawn = figure.querySelector("svg");
    drawn.addEventListener("pointermove", (event) => show(event, drawn, of.panels));
    drawn.addEventListener("pointerleave", () => (tip.hidden = true));
  }

  for (const wide of document.querySelectorAll(".scroll")) {
    const hint = Object.assign(document.createElement("p"), { className: "hint", textContent: "Wider than the window: scroll it sideways →", hidden: true });
    wide.before(hint);
    new ResizeObserver(() => (hint.hidden = wide.scrollWidth <= wide.clientWidth + 1)).observe(wide);
  }
})();
