// The moving patch: a map from above and a relief beside it. The slider chooses the instant, the list the field; drag
// the relief to turn it.
{
const pixelsWide = 452, pixelsHigh = 330;
const ink = "#1c2530", soft = "#5f6b78", slipping = "#c4472b";

const shade = (stops, share) => {
  const at = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const i = Math.min(Math.floor(at), stops.length - 2);
  return `rgb(${stops[i].map((low, c) => Math.round(low + (at - i) * (stops[i + 1][c] - low))).join()})`;
};
const roundTicks = (low, high, count) => {
  const rough = (high - low) / count;
  const decade = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].find((factor) => factor * decade >= rough) * decade;
  const values = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) values.push(i * step);
  return values;
};
const plain = (value) => String(Number(value.toPrecision(4))).replace("-", "−");
// Borders of the cells about values in order.
const borders = (values) => values.map((v, i) => (v + values[Math.max(i - 1, 0)]) / 2)
    .concat(values[values.length - 1]);

const canvasOf = (figure, name) => {
  const canvas = figure.querySelector(`canvas.${name}`);
  const ratio = Math.max(window.devicePixelRatio || 1, 2);
  canvas.width = pixelsWide * ratio;
  canvas.height = pixelsHigh * ratio;
  const pen = canvas.getContext("2d");
  pen.scale(ratio, ratio);
  pen.font = "12px sans-serif";
  return pen;
};

for (const figure of document.querySelectorAll("figure.movie")) {
  const movie = JSON.parse(figure.querySelector("script").textContent);
  const bytes = Uint8Array.from(atob(movie.values), (c) => c.charCodeAt(0));
  const [rows, stations] = [movie.y.length, movie.frames[0].x.length];
  const [play, slider, choice, note] =
      ["button", "input", "select", ".note"].map((what) => figure.querySelector(what));
  const [plan, relief] = [canvasOf(figure, "plan"), canvasOf(figure, "relief")];
  movie.labels.forEach((label, i) => choice.add(new Option(label, i)));

  const layer = (frame, part) => (i, row) =>
      bytes[((frame * (movie.labels.length + 1) + part) * stations + i) * rows + row];
  // Half the length that patches cover about the wheel.
  let half = 0;
  movie.frames.forEach((frame, k) => {
    const state = layer(k, movie.labels.length);
    frame.x.forEach((x, i) => {
      for (let row = 0; row < rows; ++row)
        if (state(i, row)) half = Math.max(half, Math.abs(x - frame.centre));
    });
  });
  half = 1.15 * half || 1;
  const yBorders = borders(movie.y);
  const [yLow, yHigh] = [yBorders[0], yBorders[rows]];

  const drawPlan = (k, field) => {
    const frame = movie.frames[k];
    const [value, state] = [layer(k, field), layer(k, movie.labels.length)];
    const scale = Math.min((pixelsWide - 130) / (2 * half), (pixelsHigh - 70) / (yHigh - yLow));
    const left = 56, right = left + 2 * half * scale;
    const top = (pixelsHigh - 46 - (yHigh - yLow) * scale) / 2, bottom = top + (yHigh - yLow) * scale;
    const px = (x) => left + (x - frame.centre + half) * scale;
    const py = (y) => bottom - (y - yLow) * scale;
    const xs = borders(frame.x);
    plan.clearRect(0, 0, pixelsWide, pixelsHigh);
    plan.save();
    plan.beginPath();
    plan.rect(left, top, right - left, bottom - top);
    plan.clip();
    for (let i = 0; i < stations; ++i)
      for (let row = 0; row < rows; ++row) {
        if (!state(i, row)) continue;
        plan.fillStyle = shade(movie.stops, value(i, row) / 255);
        plan.fillRect(px(xs[i]), py(yBorders[row + 1]), (xs[i + 1] - xs[i]) * scale + .4,
                      (yBorders[row + 1] - yBorders[row]) * scale + .4);
      }
    // Around the patch and between what sticks and what slips.
    const edge = (a, b, x1, y1, x2, y2) => {
      if (a === b) return;
      plan.strokeStyle = a && b ? slipping : ink;
      plan.lineWidth = a && b ? 2 : 1;
      plan.beginPath();
      plan.moveTo(x1, y1);
      plan.lineTo(x2, y2);
      plan.stroke();
    };
    for (let i = 0; i <= stations; ++i)
      for (let row = 0; row <= rows; ++row) {
        const here = i < stations && row < rows ? state(i, row) : 0;
        if (row < rows)
          edge(i > 0 ? state(i - 1, row) : 0, here, px(xs[i]), py(yBorders[row]), px(xs[i]), py(yBorders[row + 1]));
        if (i < stations)
          edge(row > 0 ? state(i, row - 1) : 0, here, px(xs[i]), py(yBorders[row]), px(xs[i + 1]), py(yBorders[row]));
      }
    plan.restore();

    plan.strokeStyle = "#8a949e";
    plan.lineWidth = 1;
    plan.strokeRect(left, top, right - left, bottom - top);
    plan.fillStyle = soft;
    plan.textAlign = "center";
    for (const x of roundTicks(-half, half, 6)) {
      plan.fillRect(px(x + frame.centre), bottom, 1, 5);
      plan.fillText(plain(x), px(x + frame.centre), bottom + 18);
    }
    plan.textAlign = "right";
    for (const y of roundTicks(yLow, yHigh, 6)) {
      plan.fillRect(left - 5, py(y), 5, 1);
      plan.fillText(plain(y), left - 8, py(y) + 4);
    }
    plan.fillStyle = ink;
    plan.textAlign = "center";
    plan.fillText(movie.xLabel, (left + right) / 2, bottom + 38);
    plan.save();
    plan.translate(14, (top + bottom) / 2);
    plan.rotate(-Math.PI / 2);
    plan.fillText(movie.yLabel, 0, 0);
    plan.restore();
    // Scale of colours.
    const bar = Math.min(right + 16, pixelsWide - 66);
    for (let i = 0; i < 64; ++i) {
      plan.fillStyle = shade(movie.stops, (i + .5) / 64);
      plan.fillRect(bar, bottom - (i + 1) / 64 * (bottom - top), 14, (bottom - top) / 64 + .5);
    }
    plan.fillStyle = soft;
    plan.textAlign = "left";
    const largest = movie.largest[field] || 1;
    for (const v of roundTicks(0, largest, 5))
      plan.fillText(plain(v), bar + 19, bottom - v / largest * (bottom - top) + 4);
  };

  let [azimuth, elevation] = [-.6, .55];
  const drawRelief = (k, field) => {
    const frame = movie.frames[k];
    const value = layer(k, field);
    const middle = (yLow + yHigh) / 2;
    const scale = .72 * pixelsWide / Math.hypot(2 * half, yHigh - yLow);
    const [ca, sa, ce, se] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(elevation), Math.sin(elevation)];
    const high = .5 * pixelsHigh;
    const project = (x, y, z) => {
      const depth = x * sa + y * ca;
      return [pixelsWide / 2 + (x * ca - y * sa) * scale, .6 * pixelsHigh - depth * se * scale - z * high * ce, depth];
    };
    const faces = [];
    for (let i = 0; i + 1 < stations; ++i) {
      const [x0, x1] = [frame.x[i] - frame.centre, frame.x[i + 1] - frame.centre];
      if (x0 < -half || x1 > half) continue;
      for (let row = 0; row + 1 < rows; ++row) {
        const [y0, y1] = [movie.y[row] - middle, movie.y[row + 1] - middle];
        const z = [value(i, row), value(i + 1, row), value(i + 1, row + 1), value(i, row + 1)].map((v) => v / 255);
        const corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(([x, y], c) => project(x, y, z[c]));
        faces.push({corners, mean: (z[0] + z[1] + z[2] + z[3]) / 4,
                    depth: corners[0][2] + corners[1][2] + corners[2][2] + corners[3][2]});
      }
    }
    faces.sort((a, b) => b.depth - a.depth);
    relief.clearRect(0, 0, pixelsWide, pixelsHigh);
    relief.lineWidth = .4;
    relief.strokeStyle = "#8a949e";
    for (const face of faces) {
      relief.beginPath();
      face.corners.forEach(([x, y], i) => i ? relief.lineTo(x, y) : relief.moveTo(x, y));
      relief.closePath();
      relief.fillStyle = shade(movie.stops, face.mean);
      relief.fill();
      relief.stroke();
    }
    relief.strokeStyle = relief.fillStyle = ink;
    if (movie.rolls) {
      const [tail, head] = [project(-half, yLow - middle - 1.5, 0), project(half, yLow - middle - 1.5, 0)];
      relief.lineWidth = 1;
      relief.beginPath();
      relief.moveTo(tail[0], tail[1]);
      relief.lineTo(head[0], head[1]);
      relief.stroke();
      relief.textAlign = "center";
      relief.fillText("rolling", head[0], head[1] + 14);
    }
    relief.textAlign = "left";
    relief.fillText(movie.labels[field], 8, 16);
  };

  const draw = () => {
    const [k, field] = [Number(slider.value), Number(choice.value)];
    drawPlan(k, field);
    drawRelief(k, field);
    note.textContent = movie.frames[k].note;
    figure.dataset.drawn = k;
  };
  let timer = null;
  const stop = () => {
    clearInterval(timer);
    timer = null;
    play.textContent = "Play";
  };
  play.addEventListener("click", () => {
    if (timer !== null) return stop();
    if (Number(slider.value) === movie.frames.length - 1) slider.value = 0;
    play.textContent = "Stop";
    timer = setInterval(() => {
      slider.value = Number(slider.value) + 1;
      draw();
      if (Number(slider.value) === movie.frames.length - 1) stop();
    }, 60);
  });
  slider.addEventListener("input", draw);
  choice.addEventListener("change", draw);
  const canvas = relief.canvas;
  let held = null;
  canvas.addEventListener("pointerdown", (event) => {
    held = [event.clientX, event.clientY];
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (held === null) return;
    azimuth -= .01 * (event.clientX - held[0]);
    elevation = Math.min(Math.max(elevation + .01 * (event.clientY - held[1]), .05), 1.5);
    held = [event.clientX, event.clientY];
    draw();
  });
  canvas.addEventListener("pointerup", () => { held = null; });
  slider.value = Math.floor((movie.frames.length - 1) / 2);
  draw();
}
}
