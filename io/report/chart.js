// Reading values off the curves, and zooming along the abscissa: drag to zoom, double-click to go back.
// Figures of a chapter over the same abscissa zoom together.
"use strict";
for (const figure of document.querySelectorAll("figure.chart")) {
  const svg = figure.querySelector(":scope > svg");
  const data = svg.dataset;
  const [low, high, left, right] = [data.low, data.high, data.left, data.right].map(Number);
  const [at, ...outputs] = figure.querySelectorAll(".legend output");
  const bottom = Number([...svg.querySelectorAll(".panel")].pop().dataset.bottom);
  let view = [low, high];

  const element = (name, attributes) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const key in attributes) made.setAttribute(key, attributes[key]);
    return made;
  };
  const curves = [...svg.querySelectorAll(".panel")].flatMap((panel) => {
    const [bottomValue, topValue, top, base] =
        ["low", "high", "top", "bottom"].map((key) => Number(panel.dataset[key]));
    return [...panel.querySelectorAll(".curve")].map((path) => {
      const points = path.getAttribute("d").split(/(?=[ML])/).map((p) => p.slice(1).split(" ").map(Number));
      const value = (y) => bottomValue + (base - y) / (base - top) * (topValue - bottomValue);
      return {points, name: path.dataset.name, label: panel.dataset.label, value};
    });
  });
  const cursor =
      svg.appendChild(element("line", {class: "cursor", y1: 18, y2: bottom, visibility: "hidden"}));
  const chosen = svg.appendChild(element("rect", {class: "chosen", y: 18, height: bottom - 18, width: 0}));

  // Pixel of the pointer, and the abscissa there.
  const pixel = (event) => {
    const box = svg.getBoundingClientRect();
    const x = (event.clientX - box.left) / box.width * svg.viewBox.baseVal.width;
    return Math.min(Math.max(x, left), right);
  };
  const abscissa = (x) => view[0] + (x - left) / (right - left) * (view[1] - view[0]);
  const unzoomed = (value) => left + (value - low) / (high - low) * (right - left);
  const short = (value) => String(Number(value.toPrecision(4))).replace("-", "−");

  const nearest = (points, x) => {
    let [first, last] = [0, points.length - 1];
    while (last - first > 1) {
      const middle = (first + last) >> 1;
      if (points[middle][0] < x)
        first = middle;
      else
        last = middle;
    }
    return Math.abs(points[first][0] - x) < Math.abs(points[last][0] - x) ? points[first] : points[last];
  };
  const read = (x) => {
    const value = abscissa(x);
    at.textContent = `at ${short(value)}`;
    curves.forEach((curve, i) => {
      const point = nearest(curve.points, unzoomed(value));
      outputs[i].textContent = point.length === 2 ? short(curve.value(point[1])) : "";
    });
    cursor.setAttribute("x1", x);
    cursor.setAttribute("x2", x);
    cursor.setAttribute("visibility", "visible");
  };
  const leave = () => {
    for (const output of [at, ...outputs]) output.textContent = "";
    cursor.setAttribute("visibility", "hidden");
  };

  const abscissaMarks = svg.querySelector(".abscissa");
  const drawnMarks = [...abscissaMarks.querySelectorAll(".xtick")];
  const show = (from, to) => {
    view = [from, to];
    const scale = (high - low) / (to - from);
    const move = left - unzoomed(from);
    for (const group of svg.querySelectorAll(".moves"))
      group.setAttribute("transform", `matrix(${scale} 0 0 1 ${left + (move - left) * scale} 0)`);
    for (const note of svg.querySelectorAll(".follows")) {
      note.dataset.x ??= note.getAttribute("x");
      const x = left + (note.dataset.x - left + move) * scale;
      note.setAttribute("x", x);
      note.setAttribute("visibility", x < left || x > right ? "hidden" : "visible");
    }
    for (const mark of abscissaMarks.querySelectorAll(".xtick")) mark.remove();
    if (scale === 1) {
      abscissaMarks.append(...drawnMarks);
      return;
    }
    const unit = Number(abscissaMarks.dataset.factor);
    const rough = (to - from) / 9;
    const decade = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].find((factor) => factor * decade >= rough * 0.999) * decade;
    const decimals = Math.max(0, -Math.floor(Math.log10(step / unit) + 1e-9));
    for (let value = Math.ceil(from / step) * step; value <= to; value += step) {
      const x = left + (value - from) / (to - from) * (right - left);
      abscissaMarks.append(element("line", {class: "axis xtick", x1: x, x2: x, y1: bottom, y2: bottom + 5}));
      const text = element("text", {class: "tick middle xtick", x, y: bottom + 18});
      text.textContent = (value / unit).toFixed(decimals).replace("-", "−");
      abscissaMarks.append(text);
    }
  };

  figure.abscissa = abscissaMarks.dataset.label;
  // As much of it as the figure has.
  figure.zoom = (from, to) => {
    if (from < high && to > low) show(Math.max(from, low), Math.min(to, high));
  };
  const zoomAll = (from, to) => {
    for (const other of figure.closest("section").querySelectorAll("figure.chart"))
      if (other.abscissa === figure.abscissa) other.zoom(from, to);
  };

  let start = null;
  svg.addEventListener("pointerdown", (event) => {
    start = pixel(event);
    svg.setPointerCapture(event.pointerId);
    event.preventDefault();
  });
  svg.addEventListener("pointermove", (event) => {
    const x = pixel(event);
    read(x);
    if (start === null) return;
    chosen.setAttribute("x", Math.min(start, x));
    chosen.setAttribute("width", Math.abs(x - start));
  });
  svg.addEventListener("pointercancel", () => {
    start = null;
    chosen.setAttribute("width", 0);
  });
  svg.addEventListener("pointerup", (event) => {
    if (start === null) return;
    const ends = [start, pixel(event)].sort((a, b) => a - b);
    start = null;
    chosen.setAttribute("width", 0);
    if (ends[1] - ends[0] > 5) zoomAll(abscissa(ends[0]), abscissa(ends[1]));
  });
  svg.addEventListener("pointerleave", leave);
  // The points as drawn, to five digits of the range shown.
  figure.curvesAsCsv = (quoted) => {
    const lines = [["curve", "axis", figure.abscissa, "value"].map(quoted).join()];
    for (const curve of curves)
      for (const point of curve.points) {
        if (point.length !== 2) continue;
        const x = low + (point[0] - left) / (right - left) * (high - low);
        const values = [x.toPrecision(7), curve.value(point[1]).toPrecision(6)];
        lines.push([quoted(curve.name), quoted(curve.label), ...values].join());
      }
    return lines.join("\n") + "\n";
  };
  svg.addEventListener("dblclick", () => zoomAll(-Infinity, Infinity));
  figure.classList.add("live");
}
