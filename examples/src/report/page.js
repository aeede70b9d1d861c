// The only script of the page: the choice of a story, couriers put forward, and the replay. It asks for nothing from elsewhere
// and writes names as text, never as markup.
"use strict";
(() => {
  const one = (selector) => document.querySelector(selector);
  const all = (selector) => [...document.querySelectorAll(selector)];
  for (const part of all("[data-script]")) part.hidden = false;

  // The story of one order.
  const choice = one("#order");
  const tell = () => {
    for (const story of all(".story")) story.hidden = story.dataset.order !== choice.value;
  };
  if (choice) choice.addEventListener("change", tell);

  // Couriers put forward wherever they are drawn.
  const forward = new Set();
  const show = () => {
    document.body.classList.toggle("choosing", forward.size > 0);
    for (const part of all("[data-courier]")) {
      const chosen = forward.has(part.dataset.courier);
      part.classList.toggle("chosen", chosen);
      if (part.tagName === "BUTTON") part.setAttribute("aria-pressed", chosen);
    }
  };
  for (const button of all("button[data-courier]")) {
    button.addEventListener("click", () => {
      const name = button.dataset.courier;
      if (!forward.delete(name)) forward.add(name);
      show();
    });
  }

  // The replay.
  const data = one("#film");
  if (!data) return;
  const film = JSON.parse(data.textContent);
  const stage = one("#stage"), slider = one("#time"), play = one("#play"), speed = one("#speed");
  const label = one("#clock"), list = one("#lines"), timeline = one(".timeline");
  const colors = stage.dataset.colors.split(" ");
  const width = stage.viewBox.baseVal.width, height = stage.viewBox.baseVal.height;
  // On a narrow screen marks are larger beside the map, or nobody could tell their colours.
  const narrow = Math.max(1, Math.min(750 / (stage.getBoundingClientRect().width || 750), 2));
  const unit = Math.max(width, height) / 90 * narrow;
  const end = film.every * Math.max(film.samples - 1, 0);

  const unpacked = (ways, count) => {
    const bytes = Uint8Array.from(atob(ways), (letter) => letter.charCodeAt(0));
    const found = new Float64Array(count * film.samples * 2);
    let at = 0;
    const next = () => {
      let value = 0, scale = 1, byte;
      do {
        byte = bytes[at++];
        value += (byte & 127) * scale;
        scale *= 128;
      } while (byte & 128);
      return value % 2 ? -(value + 1) / 2 : value / 2;
    };
    for (let one = 0; one < count; one++) {
      let x = 0, y = 0;
      for (let sample = 0; sample < film.samples; sample++) {
        const place = 2 * (one * film.samples + sample);
        found[place] = x += next();
        found[place + 1] = y += next();
      }
    }
    return found;
  };
  const places = unpacked(film.ways, film.names.length);
  const passing = unpacked(film.passers.ways, film.passers.present.length);
  // Where vehicles head in each sample, degrees: where they go next, or where they went last or will go first if they stand.
  const headings = new Float32Array(film.passers.vehicles * film.samples);
  for (let one = 0; one < film.passers.vehicles; one++) {
    let known = null;
    for (let sample = 0; sample < film.samples; sample++) {
      const row = one * film.samples, a = 2 * (row + sample), b = sample + 1 < film.samples ? a + 2 : a;
      const x = passing[b] - passing[a], y = passing[b + 1] - passing[a + 1];
      if (Math.hypot(x, y) > 2) {
        const heading = Math.atan2(y, x) * 180 / Math.PI;
        if (known === null) headings.fill(heading, row, row + sample);
        known = heading;
      }
      headings[row + sample] = known ?? 0;
    }
  }

  const make = (name, attributes, parent) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const key in attributes) made.setAttribute(key, attributes[key]);
    return parent.appendChild(made);
  };
  // A vehicle is longer than wide, and heads where it goes; below everything else.
  const passers = film.passers.present.map((present, index) => {
    const made = index < film.passers.vehicles
      ? make("rect", {
        x: -unit * 0.5, y: -unit * 0.25, width: unit, height: unit * 0.5, rx: unit * 0.15, class: "passer vehicle",
      }, stage)
      : make("circle", { r: unit * 0.25, class: "passer walker" }, stage);
    return { made, present };
  });
  const quiet = one("#show-traffic");
  if (quiet) quiet.addEventListener("change", () => stage.classList.toggle("quiet", !quiet.checked));
  const orders = film.orders.map((order) => ({
    posted: order[1], won: order[2], picked: order[3], gone: order[4],
    from: make("circle", { cx: order[5], cy: order[6], r: unit * 0.75, class: "origin" }, stage),
    to: make("rect", {
      x: order[7] - unit * 0.6, y: order[8] - unit * 0.6, width: unit * 1.2, height: unit * 1.2, class: "door",
    }, stage),
  }));
  const couriers = film.names.map((name, index) => {
    const group = make("g", { class: "courier", "data-courier": index }, stage);
    make("title", {}, group).textContent = name;
    const disc = make("circle", { r: unit * 0.95 }, group);
    make("text", { y: unit * 0.38, "font-size": unit * 1.05 }, group).textContent = index;
    return { group, disc };
  });

  const clock = (seconds) => {
    const two = (number) => String(number).padStart(2, "0");
    const whole = Math.floor(seconds + 1e-6), hours = Math.floor(whole / 3600);
    const rest = two(whole % 60);
    return hours ? `${hours}:${two(Math.floor(whole / 60) % 60)}:${rest}` : `${Math.floor(whole / 60)}:${rest}`;
  };
  const state = (changes, sample) => {
    let low = 0, high = changes.length / 2 - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (changes[2 * middle] <= sample) low = middle; else high = middle - 1;
    }
    return changes[2 * low + 1];
  };

  let time = 0, told = null;
  const draw = () => {
    const exact = time / film.every;
    const before = Math.max(0, Math.min(Math.floor(exact + 1e-9), film.samples - 1));
    const after = Math.min(before + 1, film.samples - 1), part = Math.max(0, Math.min(exact - before, 1));
    const at = (found, index) => {
      const a = 2 * (index * film.samples + before), b = 2 * (index * film.samples + after);
      return { x: found[a] + (found[b] - found[a]) * part, y: found[a + 1] + (found[b + 1] - found[a + 1]) * part };
    };
    passers.forEach(({ made, present }, index) => {
      const here = state(present, before);
      made.style.display = here ? "" : "none";
      if (!here) return;
      const { x, y } = at(passing, index);
      const turn = index < film.passers.vehicles ? ` rotate(${headings[index * film.samples + before].toFixed(0)})` : "";
      made.setAttribute("transform", `translate(${x.toFixed(1)} ${y.toFixed(1)})${turn}`);
    });
    couriers.forEach(({ group, disc }, index) => {
      const { x, y } = at(places, index);
      group.setAttribute("transform", `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
      const now = state(film.doing[index], before);
      disc.setAttribute("fill", colors[now % colors.length]);
      group.classList.toggle("riding", now >= colors.length);
    });
    for (const order of orders) {
      const alive = order.posted <= time && (order.gone < 0 || time < order.gone);
      const won = order.won >= 0 && order.won <= time, picked = order.picked >= 0 && order.picked <= time;
      order.from.style.display = alive && !picked ? "" : "none";
      order.from.classList.toggle("waiting", won);
      order.to.style.display = alive && won ? "" : "none";
    }
    const seen = film.lines.findLastIndex((line) => line[0] <= time + 1e-6);
    if (seen !== told) {
      told = seen;
      list.replaceChildren(...film.lines.slice(Math.max(0, seen - 5), seen + 1).reverse().map((line) => {
        const item = document.createElement("li"), when = document.createElement("time");
        when.textContent = clock(line[0]);
        item.append(when, " ", line[1]);
        return item;
      }));
    }
    slider.value = time;
    label.textContent = `${clock(time)} of ${clock(end)}`;
    slider.setAttribute("aria-valuetext", label.textContent);
    stage.dataset.time = time;
    if (timeline) {
      const from = Number(timeline.dataset.from), to = Number(timeline.dataset.to);
      const line = timeline.querySelector(".now"), x = from + (to - from) * (end > 0 ? time / end : 0);
      line.setAttribute("x1", x);
      line.setAttribute("x2", x);
      line.setAttribute("visibility", "visible");
    }
  };
  const seek = (to) => {
    time = Math.max(0, Math.min(Number.isFinite(to) ? to : 0, end));
    draw();
  };

  // The first frame sets the clock alone: its time may lie before the click that began the film.
  let playing = false, last = null;
  const frame = (now) => {
    if (!playing) return;
    if (last !== null) seek(time + (now - last) / 1000 * Number(speed.value));
    last = now;
    if (time >= end) toggle(); else requestAnimationFrame(frame);
  };
  const toggle = () => {
    playing = !playing;
    play.textContent = playing ? "Pause" : "Play";
    play.setAttribute("aria-pressed", playing);
    if (!playing) return;
    if (time >= end) seek(0);
    last = null;
    requestAnimationFrame(frame);
  };
  play.addEventListener("click", toggle);
  slider.addEventListener("input", () => seek(Number(slider.value)));
  slider.addEventListener("keydown", (event) => {
    if (event.key !== " ") return;
    event.preventDefault();
    toggle();
  });
  if (timeline) {
    timeline.addEventListener("click", (event) => {
      const box = timeline.getBoundingClientRect(), scale = timeline.viewBox.baseVal.width / box.width;
      const from = Number(timeline.dataset.from), to = Number(timeline.dataset.to);
      seek(((event.clientX - box.left) * scale - from) / (to - from) * end);
    });
  }

  // What an address asks for: #t=120, #t=120&play, #order=17, or all of it.
  const asked = () => {
    const wishes = new URLSearchParams(location.hash.slice(1));
    if (wishes.has("t")) seek(Number(wishes.get("t")));
    if (wishes.has("play") && !playing) toggle();
    if (choice && wishes.has("order") && [...choice.options].some((option) => option.value === wishes.get("order"))) {
      choice.value = wishes.get("order");
      tell();
    }
  };
  addEventListener("hashchange", asked);
  seek(0);
  asked();
})();
