"use strict";
(function () {
  const holder = document.getElementById("axes-view");
  const scene = JSON.parse(document.getElementById("scene").textContent);
  const W = 960, H = 560;
  document.documentElement.classList.add("interactive");
  const svg = holder.querySelector("svg"), NS = svg.namespaceURI;
  const start = { view: scene.view.map((r) => r.slice()), zoom: 1 };
  let view, zoom, scale = 1, lift = 0, letter = 1;

  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const along = (p, s, d) => [p[0] + s * d[0], p[1] + s * d[1], p[2] + s * d[2]];
  const unit = (a) => { const n = Math.hypot(a[0], a[1], a[2]); return [a[0] / n, a[1] / n, a[2] / n]; };
  function turn(v, k, angle) {
    const c = Math.cos(angle), s = Math.sin(angle), kv = cross(k, v), kd = dot(k, v) * (1 - c);
    return [0, 1, 2].map((i) => v[i] * c + kv[i] * s + k[i] * kd);
  }
  const offset = (p) => [p[0] - scene.center[0], p[1] - scene.center[1], p[2] - scene.center[2]];
  function fit() {
    let across = 1, low = Infinity, high = -Infinity;
    for (const corner of scene.corners) {
      const q = offset(corner), h = dot(q, scene.up), v = dot(q, view[1]);
      across = Math.max(across, Math.sqrt(Math.max(dot(q, q) - h * h, 0)));
      low = Math.min(low, v);
      high = Math.max(high, v);
    }
    lift = (low + high) / 2;
    scale = zoom * Math.min((W / 2 - 80) / across, (H / 2 - 50) / Math.max((high - low) / 2, 1));
  }
  function project(p) {
    const q = offset(p);
    return [W / 2 + scale * dot(q, view[0]), H / 2 - scale * (dot(q, view[1]) - lift), dot(q, view[2])];
  }
  function put(tag, attributes, text) {
    const e = document.createElementNS(NS, tag);
    for (const name in attributes) e.setAttribute(name, attributes[name]);
    if (text !== undefined) e.textContent = text;
    svg.appendChild(e);
    return e;
  }
  const line = (a, b, cls, colour) =>
    put("line", { x1: a[0].toFixed(1), y1: a[1].toFixed(1), x2: b[0].toFixed(1), y2: b[1].toFixed(1), class: cls,
      style: colour ? "stroke:" + colour : "" });
  function head(a, b, colour, size) {
    const dx = b[0] - a[0], dy = b[1] - a[1], n = Math.hypot(dx, dy);
    if (n < 4) return;
    const u = dx / n, v = dy / n, l = Math.min(size, n);
    const corners = [[b[0] + u * 2, b[1] + v * 2], [b[0] - l * u - 0.45 * l * v, b[1] - l * v + 0.45 * l * u],
      [b[0] - l * u + 0.45 * l * v, b[1] - l * v - 0.45 * l * u]];
    put("polygon", { points: corners.map((c) => c[0].toFixed(1) + "," + c[1].toFixed(1)).join(" "),
      style: "fill:" + colour });
  }
  function tube(axis, colour) {
    const a = project(along(axis.nearest, axis.begin, axis.direction));
    const b = project(along(axis.nearest, axis.end, axis.direction));
    let nx = -(b[1] - a[1]), ny = b[0] - a[0];
    const n = Math.hypot(nx, ny) || 1;
    nx /= n; ny /= n;
    const upper = [], lower = [];
    for (let i = 0; i <= 16; i++) {
      const s = axis.begin + (axis.end - axis.begin) * i / 16;
      const p = project(along(axis.nearest, s, axis.direction));
      const r = scale * scene.factor * Math.hypot(axis.point_std, s * axis.direction_std);
      upper.push((p[0] + r * nx).toFixed(1) + "," + (p[1] + r * ny).toFixed(1));
      lower.unshift((p[0] - r * nx).toFixed(1) + "," + (p[1] - r * ny).toFixed(1));
    }
    put("polygon", { points: upper.concat(lower).join(" "), class: "tube", style: "fill:" + colour });
  }
  const around = [0, 30, -30, 60, -60, 90, -90, 130, -130, 180].map((d) => d * Math.PI / 180);
  function crosses(segment, box) {
    for (let i = 0; i <= 24; i++) {
      const x = segment[0][0] + (segment[1][0] - segment[0][0]) * i / 24;
      const y = segment[0][1] + (segment[1][1] - segment[0][1]) * i / 24;
      if (Math.abs(x - box.x) < box.w / 2 + 2 && Math.abs(y - box.y) < 11 * letter) return true;
    }
    return false;
  }
  function place(labels, segments) {
    const placed = [];
    for (const l of labels) {
      const heading = Math.atan2(l.at[1] - l.away[1], l.at[0] - l.away[0]);
      let best = null;
      for (const reach of [1, 1.9]) for (const turned of around) {
        const c = Math.cos(heading + turned), s = Math.sin(heading + turned);
        const box = { x: l.at[0] + c * (reach * 9 + l.w / 2), y: l.at[1] + s * reach * 17 * letter, w: l.w };
        let cost = Math.abs(turned) * 0.3 + (reach - 1);
        for (const other of placed) {
          if (Math.abs(box.x - other.x) < (box.w + other.w) / 2 + 3 && Math.abs(box.y - other.y) < 18 * letter) cost += 10;
        }
        for (const segment of segments) if (crosses(segment, box)) cost += 2;
        if (box.x < l.w / 2 || box.x > W - l.w / 2 || box.y < 14 || box.y > H - 12) cost += 5;
        if (!best || cost < best.cost) best = { ...box, cost };
      }
      placed.push(best);
      l.x = best.x;
      l.y = best.y;
    }
  }
  function draw() {
    svg.textContent = "";
    letter = Math.min(Math.max(W / (svg.clientWidth || W), 1), 1.8);
    svg.style.setProperty("--letter", letter);
    fit();
    const labels = [], segments = [];
    const label = (at, away, text, colour, small) =>
      labels.push({ at, away, text, colour, small, w: (small ? 8 : 9.6) * letter * text.length });
    const arrow = (a, b, cls, colour, size) => {
      line(a, b, cls, colour);
      head(a, b, colour, size);
      segments.push([a, b]);
    };
    for (const [a, b] of scene.links) line(project(a), project(b), "link");
    const middle = (axis) => project(along(axis.nearest, (axis.begin + axis.end) / 2, axis.direction))[2];
    for (const axis of scene.axes.slice().sort((p, q) => middle(p) - middle(q))) {
      const colour = "var(--joint" + axis.index % 8 + ")";
      if (axis.truth) {
        const more = 0.2 * (axis.end - axis.begin);
        line(project(along(axis.truth[0], axis.begin - more, axis.truth[1])),
          project(along(axis.truth[0], axis.end + more, axis.truth[1])), "true-axis");
      }
      tube(axis, colour);
      const a = project(along(axis.nearest, axis.begin, axis.direction));
      const b = project(along(axis.nearest, axis.end, axis.direction));
      arrow(a, b, "axis", colour, 13);
      label(b, a, axis.name, colour, false);
    }
    const o = project([0, 0, 0]);
    const tips = scene.triad.map((tip, k) => [tip, "xyz"[k], "var(--" + "xyz"[k] + ")"]);
    for (const [tip, name, colour] of tips.concat([[scene.gravity, "gravity", "var(--ink)"]])) {
      const t = project(tip);
      arrow(o, t, "triad", colour, 9);
      if (Math.hypot(t[0] - o[0], t[1] - o[1]) > 6) label(t, o, name, colour, true);
    }
    put("circle", { cx: o[0].toFixed(1), cy: o[1].toFixed(1), r: 4.5, class: "sensor" });
    place(labels, segments);
    for (const l of labels) {
      put("text", { x: l.x.toFixed(1), y: (l.y + 5 * letter).toFixed(1), "text-anchor": "middle",
        class: l.small ? "label small" : "label", style: "fill:" + l.colour }, l.text);
    }
    bar();
  }
  function bar() {
    const wanted = 140 / scale;
    const power = Math.pow(10, Math.floor(Math.log10(wanted)));
    const length = power * [5, 2, 1].find((step) => step * power <= wanted);
    const px = length * scale;
    line([20, H - 18], [20 + px, H - 18], "scale");
    put("text", { x: 28 + px, y: H - 13, class: "label small", style: "fill:var(--soft)" }, length + " mm");
  }
  function rotate(dx, dy) {
    view = view.map((row) => turn(row, unit(scene.up), -dx));
    const towards = turn(view[2], view[0], -dy);
    const level = dot(towards, scene.up);
    if (Math.abs(level) < 0.999) view = [view[0], cross(towards, view[0]), towards];
    draw();
  }
  function look(elevation, azimuth) {
    const u = unit(scene.up);
    const right = turn(start.view[0], u, azimuth);
    const level = cross(right, u);
    const towards = [0, 1, 2].map((i) => level[i] * Math.cos(elevation) + u[i] * Math.sin(elevation));
    view = [right, cross(towards, right), towards];
    draw();
  }
  function reset() {
    view = start.view.map((r) => r.slice());
    zoom = 1;
    draw();
  }
  const magnify = (by) => { zoom = Math.min(Math.max(zoom * by, 0.3), 12); draw(); };
  let last = null;
  svg.addEventListener("pointerdown", (e) => { last = [e.clientX, e.clientY]; svg.setPointerCapture(e.pointerId); });
  svg.addEventListener("pointermove", (e) => {
    if (!last) return;
    rotate((e.clientX - last[0]) * 0.009, (e.clientY - last[1]) * 0.009);
    last = [e.clientX, e.clientY];
  });
  for (const end of ["pointerup", "pointercancel"]) svg.addEventListener(end, () => { last = null; });
  svg.addEventListener("dblclick", reset);
  svg.addEventListener("keydown", (e) => {
    const moves = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
    if (moves[e.key]) { rotate(...moves[e.key]); e.preventDefault(); }
    if (e.key === "+" || e.key === "=") magnify(1.25);
    if (e.key === "-") magnify(0.8);
  });
  const actions = { front: () => look(0, 0), side: () => look(0, Math.PI / 2), top: () => look(1.5, 0),
    closer: () => magnify(1.25), farther: () => magnify(0.8), reset };
  for (const button of holder.querySelectorAll("button")) {
    button.addEventListener("click", actions[button.dataset.action]);
  }
  window.addEventListener("resize", draw);
  reset();
})();
