"use strict";
// Draws the page from the data beside it. Texts of configs get in as text only, never as markup.
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const SVG = "http://www.w3.org/2000/svg";
  const byId = (id) => document.getElementById(id);

  function element(name, attributes = {}, ...children) {
    const node = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    node.append(...children);
    return node;
  }

  function drawing(name, attributes = {}, text = "") {
    const node = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    node.textContent = text;
    return node;
  }

  const short = (value) => (value === null ? "∞" : String(Number(value.toPrecision(3))));
  const count = (value) => value.toLocaleString("en");

  // ---- The figure: cells in rows and columns.
  function drawFigure() {
    const sheet = element("div", { class: "sheet" });
    const columns = Math.max(...data.rows.map((row) => row.cells.length));
    sheet.style.setProperty("--columns", columns);
    const head = element("div");
    for (const cell of data.rows[0].cells) head.append(element("span", { class: "column" }, cell.label));
    sheet.append(element("div", { class: "strip" }, element("span"), head));
    for (const row of data.rows) {
      const cells = element("div");
      for (const cell of row.cells) {
        const picture = element("img", {
          src: cell.image, width: cell.width, height: cell.height, alt: [row.label, cell.label].filter(Boolean).join(", "),
        });
        cells.append(element("a", { href: cell.name + ".png", title: cell.name + ".png" }, picture));
      }
      sheet.append(element("div", { class: "strip" }, element("span", {}, row.label), cells));
    }
    if (data.legend) {
      const { image, width, height, meaning, low, high } = data.legend;
      const alt = `colours from ${short(low)} to ${short(high)}: ${meaning}`;
      const bar = element("img", { class: "legend", src: image, width, height, alt });
      bar.style.width = `${width}px`;
      sheet.append(bar);
    }
    byId("figure").append(sheet);
  }

  // ---- Small plots. Each is drawn in a box of 320 units' width.
  function ratioPlot(row) {
    const width = 320, height = 130, left = 30, right = 312, top = 10, bottom = 108;
    const frames = row.frames;
    const largest = Math.max(1.2, ...frames.flatMap((f) => [f.area_ratio, f.volume_ratio])) * 1.05;
    const x = (alpha) => left + alpha * (right - left), y = (value) => bottom - (value / largest) * (bottom - top);
    const middle = frames.reduce((a, b) => (Math.abs(a.alpha - 0.5) < Math.abs(b.alpha - 0.5) ? a : b));
    const svg = drawing("svg", {
      viewBox: `0 0 ${width} ${height}`, role: "img",
      "aria-label": `${row.label}: at α = ${short(middle.alpha)} the area is ${short(middle.area_ratio)} and the volume ` +
        `${short(middle.volume_ratio)} of what lies between the shapes`,
    });
    for (const value of [0, 0.5, 1]) {
      svg.append(drawing("line", { class: "axis", x1: left, x2: right, y1: y(value), y2: y(value) }));
      svg.append(drawing("text", { x: left - 5, y: y(value) + 4, "text-anchor": "end" }, String(value)));
    }
    svg.append(drawing("text", { x: left, y: height - 6 }, "α = 0"));
    svg.append(drawing("text", { x: right, y: height - 6, "text-anchor": "end" }, "1"));
    const legend = { area: 110, volume: 190 };
    for (const name of ["area", "volume"]) {
      const of = (frame) => frame[name + "_ratio"];
      svg.append(drawing("polyline", {
        class: name, points: frames.map((f) => `${x(f.alpha)},${y(of(f))}`).join(" "),
      }));
      for (const frame of frames) svg.append(drawing("circle", { class: name, cx: x(frame.alpha), cy: y(of(frame)), r: 2.5 }));
      svg.append(drawing("text", { class: name, x: legend[name], y: height - 6 }, "● " + name));
    }
    const now = drawing("line", { class: "now", y1: top, y2: bottom });
    svg.append(now);
    svg.showAlpha = (alpha) => { now.setAttribute("x1", x(alpha)); now.setAttribute("x2", x(alpha)); };
    return svg;
  }

  // Median, 95 % and worst of each map on a logarithmic axis from 1.
  function distortionPlot(maps) {
    const width = 320, left = 96, right = 298, line = 30, top = 8;
    const height = top + maps.length * line + 38;
    const values = maps.flatMap((map) => [map.area_distortion.worst, map.angle_distortion.worst]).filter((v) => v !== null);
    const decades = Math.max(1, Math.ceil(Math.log10(Math.max(...values, 1)) - 1e-9));
    const x = (value) => left + (value === null ? 1 : Math.log10(value) / decades) * (right - left);
    const label = maps.map((map) => `${map.of}: area ${short(map.area_distortion.median)}, angle ` +
      short(map.angle_distortion.median)).join("; ");
    const svg = drawing("svg", {
      viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": "Median distortion of the maps: " + label,
    });
    const step = Math.ceil(decades / 5);
    for (let k = 0; k <= decades; k += step) {
      svg.append(drawing("line", { class: "axis", x1: x(10 ** k), x2: x(10 ** k), y1: top, y2: height - 36 }));
      svg.append(drawing("text", { x: x(10 ** k), y: height - 23, "text-anchor": "middle" }, k < 4 ? String(10 ** k) : "1e" + k));
    }
    svg.append(drawing("text", { class: "area", x: left, y: height - 4 }, "● area"));
    svg.append(drawing("text", { class: "volume", x: left + 80, y: height - 4 }, "● angle"));
    maps.forEach((map, i) => {
      const y = top + i * line + line / 2;
      svg.append(drawing("text", { x: left - 8, y: y + 4, "text-anchor": "end" }, map.of));
      [["area", -5], ["angle", 5]].forEach(([name, shift]) => {
        const d = map[name + "_distortion"], kind = name === "area" ? "area" : "volume";
        svg.append(drawing("line", { class: kind, x1: x(d.median), x2: x(d.worst), y1: y + shift, y2: y + shift, "stroke-opacity": 0.45 }));
        svg.append(drawing("circle", { class: kind, cx: x(d.median), cy: y + shift, r: 3.5 }));
        svg.append(drawing("circle", { class: kind, cx: x(d.p95), cy: y + shift, r: 2 }));
        svg.append(drawing("line", { class: kind, x1: x(d.worst), x2: x(d.worst), y1: y + shift - 3, y2: y + shift + 3 }));
      });
    });
    return svg;
  }

  // ---- The morph: all rows at one place, moved by one slider.
  function drawMorph() {
    const rows = data.rows.filter((row) => row.motion && row.motion.stills.length > 0);
    if (rows.length === 0) return;
    byId("morph").hidden = false;
    const alphas = rows[0].motion.alphas;
    const viewers = rows.map((row) => {
      const picture = element("img", { width: row.motion.width, height: row.motion.height, alt: "" });
      const stills = row.motion.stills.map((uri) => { const image = new Image(); image.src = uri; return image; });
      const card = element("div", { class: "card viewer" }, element("h3", {}, row.label), picture);
      const plot = row.frames.length > 0 ? ratioPlot(row) : null;
      if (plot) card.append(plot);
      for (const warning of row.warnings) card.append(element("p", { class: "warning" }, warning));
      byId("viewers").append(card);
      return { row, picture, stills, plot };
    });

    const slider = byId("scrub"), output = byId("position"), button = byId("play");
    slider.max = alphas.length - 1;
    function show(index) {
      slider.value = index;
      const alpha = alphas[index], text = "α = " + alpha.toFixed(2);
      output.value = text;
      slider.setAttribute("aria-valuetext", text);
      for (const { row, picture, stills, plot } of viewers) {
        picture.src = stills[index].src;
        picture.alt = `${row.label}, ${text}`;
        if (plot) plot.showAlpha(alpha);
      }
    }

    let timer = null, direction = 1;
    function play(on) {
      clearInterval(timer);
      timer = on ? setInterval(() => {
        const index = Number(slider.value);
        if (index >= alphas.length - 1) direction = -1;
        if (index <= 0) direction = 1;
        show(Math.min(Math.max(index + direction, 0), alphas.length - 1));
      }, 1000 / 16) : null;
      button.textContent = on ? "Pause" : "Play";
      button.setAttribute("aria-pressed", String(on));
    }
    slider.addEventListener("input", () => { play(false); show(Number(slider.value)); });
    button.addEventListener("click", () => play(timer === null));
    // The slider has the arrow keys when it has the focus; so has the page while nothing else wants them.
    document.addEventListener("keydown", (event) => {
      if (event.target !== document.body || event.altKey || event.ctrlKey || event.metaKey) return;
      const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (step) {
        play(false);
        show(Math.min(Math.max(Number(slider.value) + step, 0), alphas.length - 1));
      } else if (event.key === " ") {
        play(timer === null);
      } else {
        return;
      }
      event.preventDefault();
    });
    show(Math.floor(alphas.length / 2));
  }

  // ---- Videos are in the page, unless they are large: then they lie beside it.
  function drawVideos() {
    const films = data.rows.map((row) => [row.video, row.label, row.motion?.stills[0]]);
    films.push([data.turntable, "Turntable", data.rows.at(-1).cells.at(-1)?.image]);
    for (const [video, label, poster] of films) {
      if (!video || video.files.length === 0) continue;
      const player = element("video", {
        controls: "", loop: "", muted: "", playsinline: "", preload: "metadata", width: video.width, height: video.height,
        "aria-label": label,
      });
      player.muted = true;
      if (poster) player.poster = poster;
      const sources = video.films.length > 0 ? video.films : video.files;
      video.files.forEach((file, i) => player.append(element("source", { src: sources[i], type: "video/" + file.split(".").pop() })));
      const links = element("p", { class: "quiet" });
      for (const file of video.files) links.append(element("a", { href: file }, file), " ");
      player.lastChild.addEventListener("error", () => {
        player.hidden = true;
        links.prepend("Cannot be played here; the files lie beside the page where it was made: ");
      });
      byId("films").append(element("div", { class: "card" }, element("h3", {}, label), player, links));
    }
    if (data.no_videos) byId("films").append(element("p", { class: "quiet" }, "No videos: " + data.no_videos + "."));
    byId("videos").hidden = byId("films").childElementCount === 0;
  }

  // ---- What each morph is made of; rows may share one.
  function panels(pictures, alt) {
    const grid = element("div", { class: "panels" });
    for (const picture of pictures) {
      const image = element("img", { src: picture.image, width: picture.width, height: picture.height, alt: alt(picture.label) });
      grid.append(element("figure", {}, image, element("figcaption", {}, picture.label)));
    }
    return grid;
  }

  function drawMadeOf() {
    data.morphs.forEach((morph, i) => {
      const maps = morph.map_pictures || [], features = morph.feature_pictures || [];
      if (maps.length + features.length === 0) return;
      const rows = data.rows.filter((row) => row.morph === i).map((row) => row.label).join("; ");
      const body = element("div", {}, panels(maps, (of) => `${rows}: map of the ${of}, drawn as a triangulation`));
      if (features.length > 0) {
        const sum = (value) => morph.features.reduce((total, found) => total + value(found), 0);
        body.append(
          element("h3", {}, "Curvature features"),
          element("p", { class: "quiet" }, `${count(sum((f) => f.matches.length))} matched, numbered alike on both shapes, of ` +
            `${count(sum((f) => f.candidates_source.length))} candidates on the source and ` +
            `${count(sum((f) => f.candidates_target.length))} on the target (small dots); ` +
            `${count(sum((f) => f.in_place))} laid on one another. Those on the far side are not seen.`),
          panels(features, (of) => `${rows}: the ${of} with its curvature features, matched ones numbered`));
      }
      const about = ` – ${morph.domain}${features.length > 0 ? ", features" : ""}`;
      const details = element("details", {}, element("summary", {}, rows || data.title, element("span", {}, about)), body);
      details.open = byId("panels").childElementCount === 0;
      byId("panels").append(details);
    });
    byId("made-of").hidden = byId("panels").childElementCount === 0;
  }

  // ---- What was measured, per row.
  function degrees(rotation) {
    const cosine = (rotation[0] + rotation[4] + rotation[8] - 1) / 2;
    return (Math.acos(Math.min(1, Math.max(-1, cosine))) * 180) / Math.PI;
  }

  function facts(row, morph) {
    const list = [];
    const say = (name, text) => list.push([name, text]);
    const mesh = (m, role) => `${m.name === role ? "" : m.name + ": "}${count(m.vertices)} vertices, ${count(m.triangles)} triangles, ` +
      (m.closed ? "closed" : `${m.boundary_loops} boundary loop${m.boundary_loops === 1 ? "" : "s"}`);
    say("source", mesh(morph.source, "source"));
    if (morph.target.vertices > 0) say("target", mesh(morph.target, "target"));
    if (data.show === "morph") say("method", `alignment ${row.alignment}, interpolation ${row.interpolation}`);
    const found = morph.registration;
    if (found.used) {
      say("registration", `turned by ${degrees(found.rotation).toFixed(1)}°, scale ${short(found.scale)}, residual ` +
        `${short(found.residual)}, ${found.confident ? "sure" : "unsure"}`);
    }
    if (morph.domain) say("domain", morph.domain);
    for (const map of morph.maps) {
      const range = (d) => `${short(d.median)} / ${short(d.p95)} / ${short(d.worst)}`;
      say("map", `${map.of}: ${map.weights}${map.reason ? ` (${map.reason})` : ""}, ${map.flipped} flipped; area ` +
        `${range(map.area_distortion)}, angle ${range(map.angle_distortion)}`);
    }
    for (const features of morph.features)
      say("features", `${features.matches.length} matched, ${features.in_place} laid on one another`);
    for (const overlay of morph.overlays) {
      say("overlay", `${count(overlay.vertices_a)} + ${count(overlay.vertices_b)} vertices, ${count(overlay.crossings)} ` +
        `crossings: ${count(overlay.vertices)} vertices, ${count(overlay.triangles)} triangles`);
    }
    if (row.frames.length > 0) {
      const most = (name) => Math.max(...row.frames.map((frame) => frame[name]));
      say("frames", `at most ${count(most("reversed_triangles"))} triangles reversed, ` +
        `${count(most("self_intersecting_triangles"))} intersecting; smallest angle ` +
        `${short(Math.min(...row.frames.map((frame) => frame.smallest_angle_degrees)))}°`);
    }
    for (const note of morph.notes) say("note", note);
    const stages = morph.stages.map((stage) => `${stage.name} ${stage.seconds.toFixed(2)}`).join(", ");
    if (stages) say("seconds", stages);
    const seconds = row.cells.reduce((sum, cell) => sum + cell.render_seconds, 0);
    say("pictures", `${seconds.toFixed(1)} s` + (row.video ? `, video ${row.video.render_seconds.toFixed(1)} s` : ""));
    return list;
  }

  function drawMeasurements() {
    for (const row of data.rows) {
      const morph = data.morphs[row.morph];
      const list = element("dl");
      for (const [name, text] of facts(row, morph)) list.append(element("dt", {}, name), element("dd", {}, text));
      const card = element("div", { class: "card" }, element("h3", {}, row.label || data.title), list);
      if (morph.maps.length > 0) {
        card.append(element("p", { class: "quiet" }, "Distortion of the maps: median, 95 % of the surface, " +
          "worst; 1 is none."), distortionPlot(morph.maps));
      }
      byId("measurements").append(card);
    }
    byId("measured").hidden = false;
  }

  function drawConfig() {
    const add = (name, text) => byId("config").append(element("h3", {}, name), element("pre", {}, text));
    add(data.config, data.config_text);
    for (const base of data.extends) add("extends " + base.config, base.config_text);
    if (data.overrides.length > 0) add("command line", data.overrides.map((each) => "--set " + each).join("\n"));
  }

  byId("title").textContent = data.title || data.config;
  const s = data.seconds, total = s.load + s.morph + s.check + s.panels + s.render + s.video;
  byId("about").textContent = `automorph ${data.version} · ${data.picture.width} × ${data.picture.height} pixels, ` +
    `${data.picture.spp} paths each · ${total.toFixed(0)} s · config ${data.config_hash}` +
    (data.part ? ` · only ${data.part} of the figure` : "");
  drawFigure();
  drawMorph();
  drawVideos();
  drawMadeOf();
  drawMeasurements();
  drawConfig();
})();
