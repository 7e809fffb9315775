'use strict';
(() => {
// ---------------------------------------------------------------- small tools
const model = JSON.parse(document.getElementById('model').textContent);
const at = (id) => document.getElementById(id);
const space = 'http://www.w3.org/2000/svg';

/** An element; texts are always texts, never markup. */
function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === false || value === null || value === undefined) continue;
    element.setAttribute(key, value === true ? '' : String(value));
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}
function draw(tag, attributes = {}, ...children) {
  const element = document.createElementNS(space, tag);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  element.append(...children);
  return element;
}
const count = (n) => Math.round(n).toString().replace(/\B(?=(\d{3})+(?!\d))/g, '\u202f');
const many = (n, one, more = one + 's') => `${count(n)} ${n === 1 ? one : more}`;
function short(value, digits = 4) {
  if (value === 0) return '0';
  const size = Math.abs(value);
  return size >= 1e6 || size < 1e-3 ? value.toExponential(digits - 1) : String(Number(value.toPrecision(digits)));
}
const percent = (share) => `${share > 0 && share < 0.001 ? '< 0.1' : (100 * share).toFixed(1)} %`;
function bytes(n) {
  const units = ['bytes', 'kB', 'MB', 'GB', 'TB'];
  let unit = 0;
  while (n >= 1000 && unit + 1 < units.length) { n /= 1000; ++unit; }
  return `${short(n, 3)} ${units[unit]}`;
}
const unitOf = (unit) => (unit === '' || unit === '1' || unit === 'id' ? '' : ' ' + (unit === 'scene units' ? data.units || unit : unit));
const data = model.dataset;
const sceneName = (scene) => (data.many && model.names[scene] ? model.names[scene].name : '');
const titleOf = (picture) => [sceneName(picture.scene), picture.camera, `frame ${picture.frame}`].filter((part) => part !== '').join(' · ');

// ---------------------------------------------------------------- names
const sceneTables = new Map();
function namesOf(scene) {
  if (!sceneTables.has(scene)) {
    const names = model.names[scene] || { objects: [], classes: [] };
    sceneTables.set(scene, { objects: new Map(names.objects.map((one) => [one[0], one])), classes: new Map(names.classes) });
  }
  return sceneTables.get(scene);
}
function hsv(hue, saturation, value) {
  return [5, 3, 1].map((shift) => {
    const k = (shift + hue * 6) % 6;
    return Math.floor(255 * value * (1 - saturation * Math.max(0, Math.min(k, 4 - k, 1))) + 0.5);
  });
}
/** As the sheet colours an id. */
function idColor(id) {
  if (id < model.colors.length) return model.colors[id];
  let mixed = Math.imul(id, 2654435761) >>> 0;
  mixed = (mixed ^ (mixed >>> 15)) >>> 0;
  return hsv((id * 0.6180339887498949) % 1, 0.45 + 0.5 * (mixed & 255) / 255, 0.65 + 0.35 * ((mixed >>> 8) & 255) / 255);
}
const rgb = (color) => `rgb(${color.join(',')})`;
const swatch = (id) => { const mark = make('span', { class: 'swatch', 'aria-hidden': 'true' }); mark.style.background = rgb(idColor(id)); return mark; };
function objectText(scene, id) {
  if (id === 0) return '0 background';
  const one = namesOf(scene).objects.get(id);
  return one ? `${id} ${one[1]}${one[2] ? ` (${one[2]})` : ''}` : String(id);
}
const seen = ['no surface', 'visible', 'occluded by another object', 'occluded by its own object', 'outside the picture', 'behind the camera'];

// ---------------------------------------------------------------- pictures and their values
const blocks = new Map();
/** A picture of a layer: sizes, a data URL, and values that are unpacked when they are asked for. */
function blockOf(layer, shown) {
  const key = `d${layer}-${shown}`;
  if (!blocks.has(key)) {
    const text = at(key);
    if (!text) { blocks.set(key, null); return null; }
    const [head, png, values] = text.textContent.split('|');
    const [width, height, fullWidth, fullHeight, channels, type] = head.split(' ').map((word) => (isNaN(word) ? word : Number(word)));
    blocks.set(key, { width, height, fullWidth, fullHeight, channels, type, url: 'data:image/png;base64,' + png, packed: values, values: null });
  }
  return blocks.get(key);
}
const arrays = { uint8: Uint8Array, uint16: Uint16Array, uint32: Uint32Array, float32: Float32Array };
function unpack(block) {
  if (!block.values) {
    block.values = (async () => {
      const letters = atob(block.packed);
      const packed = new Uint8Array(letters.length);
      for (let i = 0; i < letters.length; ++i) packed[i] = letters.charCodeAt(i);
      const stream = new Response(packed).body.pipeThrough(new DecompressionStream('deflate'));
      const planes = new Uint8Array(await new Response(stream).arrayBuffer());
      const kind = arrays[block.type];
      const size = kind.BYTES_PER_ELEMENT;
      const n = planes.length / size;
      const plain = new Uint8Array(planes.length);
      for (let b = 0; b < size; ++b) for (let i = 0; i < n; ++i) plain[i * size + b] = planes[b * n + i];
      block.packed = null;
      return new kind(plain.buffer);
    })();
  }
  return block.values;
}
/** The middle of the pixels that sample i stands for, as the writer took it. */
function middleOf(i, samples, pixels) {
  const first = Math.floor(i * pixels / samples);
  const end = Math.max(first + 1, Math.floor((i + 1) * pixels / samples));
  return Math.floor((first + end - 1) / 2);
}
function sampleAt(pixel, samples, pixels) { return Math.min(samples - 1, Math.max(0, Math.floor((pixel + 0.5) * samples / pixels))); }
function numberText(value, type) {
  if (Number.isNaN(value)) return 'nan';
  if (!Number.isFinite(value)) return value > 0 ? '+inf' : '-inf';
  return type === 'float32' ? String(Number(value.toPrecision(7))) : String(value);
}
function valueText(layer, block, values, sample, scene) {
  const v = Array.from(values.subarray(sample * block.channels, (sample + 1) * block.channels));
  const whole = block.type !== 'float32';
  const id = v.length >= 3 ? v[0] * 65536 + v[1] * 256 + v[2] : v[0];
  const isId = ['id', 'class', 'index', 'visibility'].includes(layer.meaning) && whole;
  if (isId && layer.invalid !== '' && layer.invalid !== '0' && String(id) === layer.invalid) return 'nothing';
  if (isId && layer.meaning === 'id') return objectText(scene, id) + (v.length === 4 ? `, coverage ${v[3]} / 255` : '');
  if (isId && layer.meaning === 'class') return id === 0 ? '0 background' : `${id} ${namesOf(scene).classes.get(id) ?? ''}`;
  if (isId && layer.meaning === 'visibility') return `${id} ${seen[id] ?? ''}`;
  if (isId) return String(id);
  if (v.every((one) => !Number.isFinite(one))) return `nothing (${numberText(v[0], block.type)})`;
  const list = v.map((one) => numberText(one, block.type)).join(', ');
  const levels = ['picture', 'mask'].includes(layer.meaning) || (block.type === 'uint8' && ['depth', 'distance'].includes(layer.meaning));
  const text = (v.length === 1 ? list : `(${list})`) + (levels ? '' : unitOf(layer.unit));
  return layer.meaning === 'displacement' && v.length > 1 ? `${text}, ${short(Math.hypot(...v), 5)} long` : text;
}

// ---------------------------------------------------------------- head
at('name').textContent = data.name;
at('kind').textContent = data.many ? 'Dataset of many scenes' : 'Dataset';
at('lead').textContent = data.info.description || data.info.name || '';
const facts = [];
if (data.many) facts.push([count(data.scenesFound), data.scenesFound === 1 ? 'scene' : 'scenes']);
facts.push([count(data.pictures), data.pictures === 1 ? 'picture' : 'pictures'], [count(data.cameras), data.cameras === 1 ? 'camera' : 'cameras'],
  [count(model.seen.objectCount), model.seen.objectCount === 1 ? 'object' : 'objects'], [count(model.layers.length), model.layers.length === 1 ? 'layer' : 'layers'],
  [count(data.files), 'files'], [bytes(data.bytes), 'on disk']);
for (const [value, what] of facts) at('facts').append(make('li', {}, make('b', {}, value), make('span', {}, what)));
const drawn = data.read < data.pictures ? `Distributions are of ${count(data.read)} pictures, drawn with seed ${data.seed} from ${count(data.pictures)}; ` : 'Distributions are of all pictures; ';
at('made').textContent = (data.scenes < data.scenesFound ? `Documents of ${count(data.scenes)} of ${count(data.scenesFound)} scenes were read. ` : '') + drawn
  + (data.shown < data.pictures ? `${many(data.shown, 'picture')} of these ${data.shown === 1 ? 'is' : 'are'} shown. ` : 'all are shown. ') + `Made by DGTk ${data.version}.`;

// ---------------------------------------------------------------- the sheet
let chosen = Math.max(0, model.layers.findIndex((layer) => layer.meaning === 'picture'));
const shots = [];
const radios = [];
const lazy = new IntersectionObserver((entries) => {
  for (const entry of entries) if (entry.isIntersecting) { entry.target.dataset.near = '1'; paint(shots[entry.target.dataset.shown]); } else delete entry.target.dataset.near;
}, { rootMargin: '300px' });

function paint(shot) {
  if (shot.layer === chosen || !shot.figure.dataset.near) return;
  shot.layer = chosen;
  const block = blockOf(chosen, shot.shown);
  shot.hold.replaceChildren(block ? make('img', { alt: '', src: block.url, decoding: 'async', draggable: 'false' }) : make('span', { class: 'none' }, 'no picture of this layer'));
}
function chooseLayer(layer, focus = false) {
  chosen = (layer + model.layers.length) % model.layers.length;
  radios.forEach((radio, i) => { radio.setAttribute('aria-checked', String(i === chosen)); radio.tabIndex = i === chosen ? 0 : -1; });
  if (focus) radios[chosen].focus();
  radios[chosen].scrollIntoView({ block: 'nearest', inline: 'nearest' });
  shots.forEach(paint);
  legend();
  say('');
  if (at('view').open) viewLayer();
}
function legend() {
  const layer = model.layers[chosen];
  const items = [];
  const kind = layer.legend.kind;
  if (kind === 'ramp') {
    const ramp = make('span', { class: 'ramp', 'aria-hidden': 'true' });
    ramp.style.background = `linear-gradient(to right, ${layer.legend.colors.join(',')})`;
    items.push(make('span', {}, short(layer.legend.low) + unitOf(layer.unit)), ramp, make('span', {}, short(layer.legend.high) + unitOf(layer.unit)),
      make('span', {}, layer.legend.log ? 'equal steps of the logarithm; one range for all pictures' : 'one range for all pictures, the outermost hundredths cut'));
  } else if (kind === 'wheel') {
    items.push(make('span', { class: 'wheel', 'aria-hidden': 'true' }), make('span', {}, `direction as hue (right red, left cyan); full colour at ${short(layer.legend.high)}${unitOf(layer.unit)}`));
  } else if (kind === 'axes') {
    items.push(make('span', {}, `components as red, green and blue${layer.frame ? `, frame: ${layer.frame}` : ''}`));
  } else if (kind === 'ids' && layer.meaning === 'class') {
    for (const row of model.seen.classes.slice(0, 16)) items.push(make('span', {}, swatch(row.id), row.name));
  } else if (kind === 'ids' && layer.meaning === 'id' && !data.many) {
    for (const row of model.seen.objects.slice(0, 16)) items.push(make('span', {}, swatch(row.id), row.name));
    if (model.seen.objectCount > 16) items.push(make('span', {}, `and ${count(model.seen.objectCount - 16)} more`));
  } else if (kind === 'ids') {
    items.push(make('span', {}, 'a colour for each number'));
  }
  at('legend').replaceChildren(make('span', {}, make('b', {}, layer.label), ` – ${layer.description}`), ...items);
}
function say(text) { at('readout').textContent = text || 'Point at a picture to read its values; Enter opens it with the values of all layers.'; }
async function readOut(shot, event) {
  const layer = model.layers[chosen];
  const block = blockOf(chosen, shot.shown);
  if (!block) return;
  const [x, y] = placeIn(shot.hold, block, event);
  const mine = readOut.turn = (readOut.turn || 0) + 1;
  const values = await unpack(block);
  if (mine !== readOut.turn) return;
  const i = sampleAt(x, block.width, block.fullWidth);
  const j = sampleAt(y, block.height, block.fullHeight);
  say(`${titleOf(model.pictures[shot.shown])} · pixel (${middleOf(i, block.width, block.fullWidth)}, ${middleOf(j, block.height, block.fullHeight)}) · ${layer.label}: `
    + valueText(layer, block, values, j * block.width + i, model.pictures[shot.shown].scene));
}
function placeIn(element, block, event) {
  const box = element.getBoundingClientRect();
  const scale = Math.min(box.width / block.fullWidth, box.height / block.fullHeight);
  return [(event.clientX - box.left - (box.width - block.fullWidth * scale) / 2) / scale - 0.5, (event.clientY - box.top - (box.height - block.fullHeight * scale) / 2) / scale - 0.5];
}
const visibleShots = () => shots.filter((shot) => !shot.figure.hidden);
/** The one that Tab reaches. */
function tabTo(next) { shots.forEach((shot) => { shot.figure.tabIndex = shot === next ? 0 : -1; }); }
function focusShot(i) {
  const visible = visibleShots();
  const next = visible[Math.min(visible.length - 1, Math.max(0, i))];
  tabTo(next);
  next.figure.focus();
}
function sheet() {
  model.layers.forEach((layer, i) => {
    const radio = make('button', { type: 'button', role: 'radio', 'aria-checked': 'false', title: layer.description }, layer.label);
    radio.addEventListener('click', () => chooseLayer(i));
    radio.addEventListener('keydown', (event) => {
      const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
      if (step) { event.preventDefault(); chooseLayer(chosen + step, true); }
    });
    radios.push(radio);
    at('layers').append(radio);
  });
  model.pictures.forEach((picture, i) => {
    const hold = make('span', { class: 'hold' });
    hold.style.aspectRatio = `${picture.width} / ${picture.height}`;
    const figure = make('figure', { class: 'shot', role: 'option', tabindex: i === 0 ? 0 : -1, 'data-shown': i, 'aria-label': titleOf(picture) }, hold,
      make('figcaption', {}, make('span', { title: titleOf(picture) }, titleOf(picture)), picture.covered === undefined ? null : make('span', { title: 'share of the picture that shows a surface' }, percent(picture.covered))));
    const shot = { shown: i, figure, hold, layer: -1 };
    shots.push(shot);
    figure.addEventListener('mousemove', (event) => readOut(shot, event));
    figure.addEventListener('mouseleave', () => { readOut.turn = (readOut.turn || 0) + 1; say(''); });
    figure.addEventListener('click', () => openView(i, figure));
    figure.addEventListener('keydown', (event) => {
      const visible = visibleShots();
      const here = visible.indexOf(shot);
      const columns = visible.filter((one) => one.figure.offsetTop === visible[0].figure.offsetTop).length;
      const step = { ArrowRight: 1, ArrowLeft: -1, ArrowDown: columns, ArrowUp: -columns, Home: -here, End: visible.length - 1 - here }[event.key];
      if (step !== undefined) { event.preventDefault(); focusShot(here + step); }
      if (event.key === 'Enter' || event.key === ' ') { event.preventDefault(); openView(i, figure); }
    });
    at('sheet').append(figure);
    lazy.observe(figure);
  });
  const groups = new Set(model.pictures.map((picture) => (data.many ? sceneName(picture.scene) : picture.camera)));
  at('filter').append(make('option', { value: '' }, data.many ? 'all scenes' : 'all cameras'), ...[...groups].map((group, i) => make('option', { value: String(i + 1) }, group)));
  at('filter').addEventListener('change', () => {
    const group = [...groups][Number(at('filter').value) - 1];
    for (const shot of shots) shot.figure.hidden = at('filter').value !== '' && (data.many ? sceneName(model.pictures[shot.shown].scene) : model.pictures[shot.shown].camera) !== group;
    tabTo(visibleShots()[0]);
  });
  if (groups.size < 2) at('filter').parentElement.hidden = true;
  const size = at('size');
  size.value = model.pictures.length <= 8 ? 400 : 220;
  const resize = () => at('sheet').style.setProperty('--size', `${size.value}px`);
  size.addEventListener('input', resize);
  resize();
  at('pictures-note').textContent = (data.shown < data.pictures ? `${count(data.shown)} of ${count(data.pictures)} pictures, drawn with seed ${data.seed}. ` : '')
    + 'Values are those of the dataset’s pixels that are named beside them: whole numbers as they are, real ones to seven digits. The number below a picture is the share of it that shows a surface.';
  document.addEventListener('keydown', (event) => {
    if ((event.key === '[' || event.key === ']') && !['SELECT', 'INPUT'].includes(event.target.tagName)) { event.preventDefault(); chooseLayer(chosen + (event.key === ']' ? 1 : -1)); }
  });
}

// ---------------------------------------------------------------- one picture
const view = { shown: 0, x: null, y: null, from: null };
function openView(shown, from) {
  view.shown = shown;
  view.from = from || view.from;
  const picture = model.pictures[shown];
  view.x = Math.min(picture.width - 1, view.x ?? Math.floor(picture.width / 2));
  view.y = Math.min(picture.height - 1, view.y ?? Math.floor(picture.height / 2));
  at('view-title').textContent = titleOf(picture);
  const frame = at('view-picture');
  frame.style.aspectRatio = `${picture.width} / ${picture.height}`;
  frame.style.maxWidth = `calc(80vh * ${picture.width / picture.height})`;
  if (!at('view').open) at('view').showModal();
  viewLayer();
  frame.focus();
}
function viewLayer() {
  const block = blockOf(chosen, view.shown);
  const children = block ? [make('img', { alt: `${model.layers[chosen].label}, ${titleOf(model.pictures[view.shown])}`, src: block.url, draggable: 'false' })] : [];
  at('view-picture').replaceChildren(...children, make('span', { class: 'cross' }));
  viewValues();
}
async function viewValues() {
  const picture = model.pictures[view.shown];
  const cross = at('view-picture').querySelector('.cross');
  const reference = blockOf(chosen, view.shown) || model.layers.map((_, i) => blockOf(i, view.shown)).find((one) => one);
  if (!reference) return;
  const i = sampleAt(view.x, reference.width, reference.fullWidth);
  const j = sampleAt(view.y, reference.height, reference.fullHeight);
  Object.assign(cross.style, { left: `${100 * (i + 0.5) / reference.width}%`, top: `${100 * (j + 0.5) / reference.height}%`, width: `${100 / reference.width}%`, height: `${100 / reference.height}%` });
  const column = middleOf(i, reference.width, reference.fullWidth);
  const row = middleOf(j, reference.height, reference.fullHeight);
  const turn = view.turn = (view.turn || 0) + 1;
  const rows = [];
  for (let k = 0; k < model.layers.length; ++k) {
    const block = blockOf(k, view.shown);
    if (!block || block.fullWidth !== reference.fullWidth || block.fullHeight !== reference.fullHeight) continue;
    const values = await unpack(block);
    if (turn !== view.turn) return;
    const text = valueText(model.layers[k], block, values, sampleAt(view.y, block.height, block.fullHeight) * block.width + sampleAt(view.x, block.width, block.fullWidth), picture.scene);
    const head = make('th', { scope: 'row' }, model.layers[k].label);
    head.addEventListener('click', () => chooseLayer(k));
    rows.push(make('tr', { class: k === chosen ? 'on' : null, 'aria-current': k === chosen ? 'true' : null }, head, make('td', {}, text)));
  }
  at('view-place').textContent = `Pixel (${column}, ${row}) of ${reference.fullWidth} × ${reference.fullHeight}`;
  at('view-values').replaceChildren(...rows);
}
function viewer() {
  const frame = at('view-picture');
  const follow = (event) => {
    const block = blockOf(chosen, view.shown);
    if (!block) return;
    const [x, y] = placeIn(frame, block, event);
    view.x = Math.min(block.fullWidth - 1, Math.max(0, Math.round(x)));
    view.y = Math.min(block.fullHeight - 1, Math.max(0, Math.round(y)));
    viewValues();
  };
  frame.addEventListener('pointermove', follow);
  frame.addEventListener('pointerdown', follow);
  const turn = (step) => {
    let next = view.shown;
    do next = (next + step + shots.length) % shots.length; while (shots[next].figure.hidden && next !== view.shown);
    openView(next);
  };
  frame.addEventListener('keydown', (event) => {
    const step = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowDown: [0, 1], ArrowUp: [0, -1] }[event.key];
    const block = blockOf(chosen, view.shown);
    if (!step || !block) return;
    event.preventDefault();
    const far = event.shiftKey ? 10 : 1;
    const move = (value, by, samples, pixels) => middleOf(Math.min(samples - 1, Math.max(0, sampleAt(value, samples, pixels) + by * far)), samples, pixels);
    view.x = move(view.x, step[0], block.width, block.fullWidth);
    view.y = move(view.y, step[1], block.height, block.fullHeight);
    viewValues();
  });
  at('view').addEventListener('keydown', (event) => {
    if (event.key === 'PageDown' || event.key === 'PageUp') { event.preventDefault(); turn(event.key === 'PageDown' ? 1 : -1); }
  });
  at('view-before').addEventListener('click', () => turn(-1));
  at('view-after').addEventListener('click', () => turn(1));
  at('view-close').addEventListener('click', () => at('view').close());
  at('view').addEventListener('click', (event) => { if (event.target === at('view')) at('view').close(); });
  at('view').addEventListener('close', () => { if (view.from) view.from.focus(); });
}

// ---------------------------------------------------------------- seen from above
function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (list) => {
    const chain = [];
    for (const p of list) {
      while (chain.length > 1) {
        const [a, b] = chain.slice(-2);
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        chain.pop();
      }
      chain.push(p);
    }
    return chain.slice(0, -1);
  };
  return half(sorted).concat(half(sorted.reverse()));
}
const footprint = (place) => { const points = []; for (let i = 4; i + 1 < place.length; i += 2) points.push([place[i], place[i + 1]]); return points; };
function placeAt(places, frame) {
  let best = null;
  for (const place of places) if (best === null || Math.abs(place[0] - frame) < Math.abs(best[0] - frame)) best = place;
  return best;
}
/** Around the cameras and what moves, and the objects that are not much larger than that. */
function extentOf(plan) {
  const points = [];
  for (const camera of plan.cameras) for (const place of camera.places) points.push([place[1], place[2]]);
  for (const object of plan.objects) for (const place of object.places) points.push([place[1], place[2]]);
  let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const [x, y] of points) { left = Math.min(left, x); right = Math.max(right, x); top = Math.min(top, y); bottom = Math.max(bottom, y); }
  if (!(right >= left)) return null;
  const size = Math.max(right - left, bottom - top) || 1;
  return { left: left - 0.14 * size, top: top - 0.14 * size, width: right - left + 0.28 * size, height: bottom - top + 0.28 * size, size };
}
function niceStep(size) {
  const power = 10 ** Math.floor(Math.log10(size));
  return [5, 2, 1].map((n) => n * power).find((step) => step <= size) || power;
}
function planPicture(plan, frame) {
  const extent = extentOf(plan);
  if (!extent) return make('p', { class: 'note' }, 'The dataset does not say where its objects are.');
  const width = 1000;
  const height = Math.min(600, Math.max(320, width * extent.height / extent.width));
  const scale = Math.min(width / extent.width, height / extent.height);
  const X = (x) => (x - extent.left - extent.width / 2) * scale + width / 2;
  const Y = (y) => (y - extent.top - extent.height / 2) * scale + height / 2;
  const there = plan.objects.filter((object) => !object.hidden.includes(frame));
  const svg = draw('svg', { viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': `Plan: ${plan.cameras.length} cameras and ${there.length} objects from above at frame ${frame}` });
  const step = niceStep(Math.max(extent.width, extent.height) / 5);
  for (let x = Math.ceil((extent.left + extent.width / 2 - width / scale) / step) * step; X(x) < width; x += step) if (X(x) > 0) svg.append(draw('line', { class: 'grid', x1: X(x), x2: X(x), y1: 0, y2: height }));
  for (let y = Math.ceil((extent.top + extent.height / 2 - height / scale) / step) * step; Y(y) < height; y += step) svg.append(draw('line', { class: 'grid', x1: 0, x2: width, y1: Y(y), y2: Y(y) }));
  const labels = [];
  const area = (object) => { const f = footprint(object.places[0]); return f.length ? Math.max(...f.map((p) => p[0])) - Math.min(...f.map((p) => p[0])) : 0; };
  for (const object of there.sort((a, b) => area(b) - area(a))) {
    const color = rgb(idColor(object.id));
    const place = placeAt(object.places, frame);
    const name = objectText(plan.scene, object.id);
    const group = draw('g', { 'data-object': object.id }, draw('title', {}, name));
    if (object.places.length > 1) group.append(draw('polyline', { class: 'way', stroke: color, points: object.places.map((p) => `${X(p[1])},${Y(p[2])}`).join(' ') }));
    const foot = hull(footprint(place));
    const large = foot.length > 2 && area(object) > 1.2 * extent.size;
    if (foot.length > 2) group.append(draw('polygon', { class: 'body', fill: large ? 'none' : color, stroke: color, points: foot.map((p) => `${X(p[0])},${Y(p[1])}`).join(' ') }));
    group.append(draw('circle', { cx: X(place[1]), cy: Y(place[2]), r: 3, fill: color }));
    svg.append(group);
    if (plan.objects.length <= 40) labels.push([X(place[1]) + 6, Y(place[2]) + 4, name.replace(/^\d+ /, '').replace(/ \(.*\)$/, '')]);
  }
  const long = 0.11 * Math.max(width, height);
  for (const camera of plan.cameras) {
    const place = placeAt(camera.places, frame);
    if (!place) continue;
    const group = draw('g', {}, draw('title', {}, `${camera.name} (${camera.model})`));
    if (camera.places.length > 1) group.append(draw('polyline', { class: 'way', stroke: 'var(--mark)', 'stroke-dasharray': '4 3', points: camera.places.map((p) => `${X(p[1])},${Y(p[2])}`).join(' ') }));
    const [u, v] = place.slice(4);
    const ends = place.length > 6 ? [6, 8, 10, 12].map((i) => place.slice(i, i + 2)) : [[u + 0.12 * v, v - 0.12 * u], [u - 0.12 * v, v + 0.12 * u]];
    group.append(draw('polygon', { class: 'cone', points: hull([[0, 0], ...ends]).map((p) => `${X(place[1]) + long * p[0]},${Y(place[2]) + long * p[1]}`).join(' ') }));
    group.append(draw('circle', { class: 'eye', cx: X(place[1]), cy: Y(place[2]), r: 4.5 }));
    svg.append(group);
    if (plan.cameras.length <= 24) labels.push([X(place[1]) + 7, Y(place[2]) - 6, camera.name]);
  }
  const taken = [];
  for (const [x, y, text] of labels) {
    const box = [x, y - 11, x + 6.2 * text.length, y];
    if (taken.some((other) => box[0] < other[2] && box[2] > other[0] && box[1] < other[3] && box[3] > other[1])) continue;
    taken.push(box);
    svg.append(draw('text', { class: 'label', x: Math.min(x, width - 6.2 * text.length), y }, text));
  }
  svg.append(draw('line', { x1: 14, x2: 14 + step * scale, y1: height - 14, y2: height - 14, stroke: 'var(--ink)', 'stroke-width': 2 }),
    draw('text', { x: 14, y: height - 20 }, `${short(step)} ${plan.units || 'scene units'}`), draw('text', { x: width - 96, y: height - 12 }, plan.up === 'z' ? 'x right, y up' : 'x right, z down'));
  return svg;
}
function plans() {
  if (model.plans.length === 0) return;
  let plan = model.plans[0];
  let frame = plan.frames[0];
  const slider = make('input', { type: 'range', min: 0, max: 0, value: 0, 'aria-label': 'Frame' });
  const frameText = make('span', {}, '');
  const show = () => {
    at('plan-plot').replaceChildren(planPicture(plan, frame));
    frameText.textContent = ` ${frame}`;
  };
  const side = () => {
    const item = (object) => {
      const line = make('li', {}, swatch(object.id), objectText(plan.scene, object.id));
      const mark = (on) => { const g = at('plan-plot').querySelector(`[data-object="${object.id}"]`); if (g) g.style.opacity = on ? '' : ''; line.classList.toggle('on', on); for (const other of at('plan-plot').querySelectorAll('g')) other.style.opacity = on && other !== g ? '0.25' : ''; };
      line.addEventListener('mouseenter', () => mark(true));
      line.addEventListener('mouseleave', () => mark(false));
      return line;
    };
    const dot = make('span', { class: 'swatch', 'aria-hidden': 'true' });
    dot.style.background = 'var(--mark)';
    at('plan-side').replaceChildren(make('h3', {}, many(plan.allCameras, 'camera')), make('ul', {}, ...plan.cameras.map((camera) => make('li', {}, dot.cloneNode(), `${camera.name} – ${camera.model}`))),
      make('h3', {}, many(plan.allObjects, 'object')), make('ul', {}, ...plan.objects.map(item)));
  };
  const choose = (next) => {
    plan = next;
    frame = plan.frames[0];
    slider.max = plan.frames.length - 1;
    slider.value = 0;
    slider.parentElement.hidden = plan.frames.length < 2;
    at('plan-note').textContent = 'Cameras in blue with the angle that they see (of lenses that are no pinholes the direction alone), objects in the colours of their ids with the box around them where the dataset has boxes, lines where they move. '
      + (plan.frames.length < plan.allFrames ? `${plan.frames.length} of ${count(plan.allFrames)} frames. ` : '') + (plan.objects.length < plan.allObjects ? `${plan.objects.length} of ${count(plan.allObjects)} objects have a place. ` : '');
    side();
    show();
  };
  if (model.plans.length > 1) {
    const scenes = make('select', { 'aria-label': 'Scene' }, ...model.plans.map((one, i) => make('option', { value: i }, sceneName(one.scene))));
    scenes.addEventListener('change', () => choose(model.plans[scenes.value]));
    at('plan-tools').append(make('label', {}, 'Scene ', scenes));
  }
  slider.addEventListener('input', () => { frame = plan.frames[slider.value]; show(); });
  at('plan-tools').append(make('label', {}, 'Frame ', slider, frameText));
  choose(plan);
}

// ---------------------------------------------------------------- distributions
/** Bars over [label, value]; `ticks` are [place from 0 to 1, text]. */
function bars(values, ticks, label) {
  const [width, height, low] = [330, 150, 126];
  const most = Math.max(1, ...values);
  const svg = draw('svg', { viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': label });
  const step = (width - 12) / values.length;
  values.forEach((value, i) => { if (value > 0) svg.append(draw('rect', { class: 'bars', x: 6 + i * step, width: Math.max(0.5, step - (step > 4 ? 1 : 0.2)), y: low - Math.max(1, (low - 8) * value / most), height: Math.max(1, (low - 8) * value / most) }, draw('title', {}, count(value)))); });
  svg.append(draw('line', { class: 'axis', x1: 6, x2: width - 6, y1: low, y2: low }));
  for (const [place, text] of ticks) svg.append(draw('line', { class: 'axis', x1: 6 + place * (width - 12), x2: 6 + place * (width - 12), y1: low, y2: low + 4 }),
    draw('text', { x: 6 + place * (width - 12), y: low + 16, 'text-anchor': place < 0.06 ? 'start' : place > 0.94 ? 'end' : 'middle' }, text));
  return svg;
}
const edgeOf = (bin) => { const octave = Math.floor(bin / 8); return 2 ** octave * (1 + (bin - 8 * octave) / 8); };
const mostOctaves = 14;
function numberBars(tally, label) {
  if (tally.bins.length === 0) return make('p', {}, tally.values > 0 ? 'All values are zero or less.' : 'No values.');
  const last = tally.bins[tally.bins.length - 1][0];
  const first = Math.max(tally.bins[0][0], last - 8 * mostOctaves + 1); // what is below stands in the first bar
  const fold = Math.max(1, Math.ceil((last - first + 1) / 96));
  const values = new Array(Math.ceil((last - first + 1) / fold)).fill(0);
  for (const [bin, n] of tally.bins) values[Math.max(0, Math.floor((bin - first) / fold))] += n;
  const ticks = [];
  let before = -1;
  for (let i = 0; i <= values.length; ++i) {
    const place = i / values.length;
    if (place - before >= 0.22 || before < 0) { ticks.push([place, (i === 0 && first > tally.bins[0][0] ? '≤ ' : '') + short(edgeOf(first + i * fold), 2)]); before = place; }
  }
  return bars(values, ticks, label);
}
function summary(tally, unit) {
  if (!(tally.values > 0)) return `${count(tally.nothing ?? 0)} values, none of them finite`;
  return `${short(tally.least)} to ${short(tally.most)}${unit}, mean ${short(tally.mean)}`;
}
function card(title, note, plot, details) {
  const more = details && details.length > 0 ? make('details', {}, make('summary', {}, 'Numbers'), make('table', {}, make('tbody', {}, ...details.map(([name, value]) => make('tr', {}, make('td', {}, name), make('td', { class: 'number' }, value)))))) : null;
  at('cards').append(make('div', { class: 'card' }, make('h3', {}, title), make('p', {}, note), plot, more));
}
function distributions() {
  at('distributions-note').textContent = data.read < data.pictures ? `Of every pixel of ${count(data.read)} pictures, drawn with seed ${data.seed} from ${count(data.pictures)}.` : 'Of every pixel of all pictures.';
  for (const layer of model.layers) {
    if (layer.numbers) {
      const t = layer.numbers;
      const kind = layer.meaning === 'displacement' ? `length of ${layer.label}` : layer.label;
      card(kind, `${summary(t, unitOf(layer.unit))}; pixels by value, eight equal steps an octave or several of these`, numberBars(t, `Distribution of ${kind}`),
        [['pictures', count(layer.pictures)], ['values', count(t.values)], ['nothing there', count(t.nothing)], ['zero', count(t.zero)], ['negative', count(t.negative)], ['least', t.least ?? '–'], ['largest', t.most ?? '–'], ['mean', t.mean ?? '–']]);
    }
    if (layer.brightness) {
      const t = layer.brightness;
      card(`Brightness of ${layer.label}`, `${summary(t, '')} of full brightness; black ${percent(t.zero / t.values)}, white ${percent(t.one / t.values)}`,
        bars(t.bins, [[0, '0'], [0.5, '0.5'], [1, '1']], `Distribution of the brightness of ${layer.label}`), [['pictures', count(layer.pictures)], ['pixels', count(t.values)], ['exactly 0', count(t.zero)], ['exactly 1', count(t.one)], ['mean', t.mean ?? '–']]);
    }
  }
  const boxes = model.seen.boxes;
  if (boxes) {
    card('Size of objects in the picture', `${summary(boxes.sizes, ' pixels')}; the longer side of the visible box`, numberBars(boxes.sizes, 'Distribution of the size of objects'), [['pictures', count(boxes.pictures)], ['boxes', count(boxes.sizes.values)]]);
    card('Visible share of objects', `${summary(boxes.shares, '')}; of the pixels that an object would have alone in the picture. ${count(boxes.hidden)} times not seen at all`,
      bars(boxes.shares.bins, [[0, '0'], [0.5, '0.5'], [1, '1']], 'Distribution of the visible share of objects'), [['objects within pictures', count(boxes.shares.values)], ['fully hidden', count(boxes.shares.zero)], ['fully visible', count(boxes.shares.one)]]);
  }
  const v = model.viewpoints;
  if (v.views > 0) {
    const most = Math.max(...v.bins);
    const svg = draw('svg', { viewBox: '0 0 330 196', role: 'img', 'aria-label': `Directions from which objects are seen: ${v.bins.filter((n) => n > 0).length} of ${v.bins.length} parts of the sphere` });
    const w = 290 / v.columns;
    const h = 160 / v.rows;
    v.bins.forEach((n, i) => svg.append(draw('rect', { x: 34 + (i % v.columns) * w, y: 4 + (v.rows - 1 - Math.floor(i / v.columns)) * h, width: w - 0.6, height: h - 0.6, fill: n === 0 ? 'var(--line)' : 'var(--bar)', 'fill-opacity': n === 0 ? 0.35 : 0.2 + 0.8 * Math.sqrt(n / most) }, draw('title', {}, count(n)))));
    for (const [degrees, place] of [[90, 0], [30, 0.25], [0, 0.5], [-30, 0.75], [-90, 1]]) svg.append(draw('text', { x: 30, y: 8 + 156 * place, 'text-anchor': 'end' }, `${degrees}°`));
    for (const [degrees, place] of [[-180, 0], [-90, 0.25], [0, 0.5], [90, 0.75], [180, 1]]) svg.append(draw('text', { x: 34 + 290 * place, y: 180, 'text-anchor': place === 0 ? 'start' : place === 1 ? 'end' : 'middle' }, `${degrees}°`));
    card('Coverage of viewpoints', `${percent(v.bins.filter((n) => n > 0).length / v.bins.length)} of all directions: where the camera stands, in the axes of each object that is seen; ${many(v.views, 'view')}. Across: azimuth; up: elevation, in equal areas`, svg, []);
  }
  if (at('cards').children.length === 0) at('cards').append(make('p', { class: 'note' }, 'The dataset has no layer whose values are counted.'));
}

// ---------------------------------------------------------------- tables
function table(caption, heads, rows) {
  const isNumber = heads.map((head) => head.startsWith('#'));
  return make('div', { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': caption }, make('table', {}, make('caption', {}, caption),
    make('thead', {}, make('tr', {}, ...heads.map((head, i) => make('th', { scope: 'col', class: isNumber[i] ? 'number' : null }, head.replace('#', ''))))),
    make('tbody', {}, ...rows.map((row) => make('tr', {}, ...row.map((cell, i) => make('td', { class: isNumber[i] ? 'number' : 'name' }, cell)))))));
}
function objects() {
  const s = model.seen;
  const all = s.objects.reduce((sum, row) => sum + row.pixels, 0) || 1;
  const allClasses = s.classes.reduce((sum, row) => sum + row.pixels, 0) || 1;
  const bar = (share) => { const mark = make('span', { class: 'share', 'aria-hidden': 'true' }); mark.style.width = `${Math.max(1, 60 * share)}px`; return mark; };
  const named = (row) => make('span', {}, swatch(row.id), row.name || '–');
  at('objects-note').textContent = s.counted ? 'Pictures in which they are seen, and their share of all pixels that show an object.' : 'The dataset has no layer of object ids: it is not counted where they are seen.';
  const seenOf = (row, whole, counted) => (counted ? [count(row.pictures), make('span', {}, bar(row.pixels / whole), ' ', percent(row.pixels / whole))] : []);
  at('classes-table').append(table(`Classes (${count(s.classCount)})`, ['class', '#objects', ...(s.classesCounted ? ['#pictures', '#pixels'] : [])],
    s.classes.map((row) => [named(row), count(row.members), ...seenOf(row, allClasses, s.classesCounted)])));
  at('objects-table').append(table(`Objects (${count(s.objectCount)}${s.objects.length < s.objectCount ? `, the first ${s.objects.length}` : ''})`,
    ['object', 'class', ...(data.many ? ['#scenes'] : []), ...(s.counted ? ['#pictures', '#pixels'] : [])],
    s.objects.map((row) => [named(row), row.class || '–', ...(data.many ? [count(row.scenes)] : []), ...seenOf(row, all, s.counted)])));
}
function frames() {
  at('frames-note').textContent = 'No file of a dataset depends on the clock, so it does not say which frames were the slowest; the largest on disk are shown instead. '
    + (data.read < data.pictures ? `Among the ${count(data.read)} pictures that were read.` : '');
  const list = (title, note, rows, value) => {
    if (rows.length === 0) return;
    at('frame-cards').append(make('div', { class: 'card' }, make('h3', {}, title), make('p', {}, note), make('ol', {}, ...rows.map((row) => {
      const text = data.many && !model.names[row.scene] ? `scene ${row.scene} · ${titleOf(row)}` : titleOf(row);
      const name = row.shown === undefined ? make('span', {}, text) : make('button', { type: 'button' }, text);
      if (row.shown !== undefined) name.addEventListener('click', () => openView(row.shown, name));
      return make('li', {}, name, make('span', {}, value(row)));
    }))));
  };
  list('Emptiest', 'share of the picture that shows a surface', model.frames.emptiest, (row) => percent(row.covered));
  list('Darkest', 'mean brightness of the first picture layer', model.frames.darkest, (row) => short(row.brightness, 3));
  list('Largest', 'all files of the picture', model.frames.largest, (row) => bytes(row.bytes));
}
function checks() {
  const parts = [];
  const doubt = (one) => (one.same ? '' : one.same === false ? 'of an earlier state, or of another dataset' : 'does not say of which dataset');
  const v = model.verification;
  if (v) {
    parts.push(make('p', {}, 'Verification: ', make('span', { class: v.same && v.passed ? 'good' : 'bad' }, doubt(v) || (v.passed ? '✓ passed' : '✗ a breach')), ` – ${many(v.residuals.length, 'residual')}`));
    parts.push(table('Verification', ['check', 'layer', '#values', '#open', '#largest', '#tolerance', 'unit', ''], v.residuals.map((row) => [row.check ?? '', row.layer ?? '', count(row.count ?? 0), count(row.skipped ?? 0), String(row.largest ?? '–'), String(row.tolerance ?? ''), row.unit ?? '',
      make('span', { class: row.breach ? 'bad' : 'good' }, row.breach ? (row.dataset ? `breach in ${row.dataset}` : 'breach') : 'ok')])));
    if (v.unchecked.length > 0) parts.push(table('Not compared by any check', ['layer', 'format', '#files'], v.unchecked.map((row) => [row.layer ?? '', row.format ?? '', count(row.files ?? 0)])));
  } else {
    parts.push(make('p', { class: 'note' }, 'No verification was given.'));
  }
  for (const one of model.exports) {
    if (!one.same) parts.push(make('p', { class: 'bad' }, `Export ${one.format}: ${doubt(one)}`));
    parts.push(table(`Export ${one.format}: ${many(one.files, 'file')}`, ['layer', '#largest rounding', 'unit', '#values', '#without a code'], one.layers.map((row) => [row.layer, short(row.largest), row.unit, count(row.values), count(row.withoutCode)])));
  }
  if (model.exports.length === 0) parts.push(make('p', { class: 'note' }, 'No export was given: how much its values are rounded is not shown.'));
  if (model.samples) {
    const s = model.samples;
    parts.push(s.reasons.length === 0 ? make('p', {}, `${many(s.samples, 'sample')}; nothing was refused.`)
      : table(`Refused or left out while sampling: in ${count(s.touched)} of ${many(s.samples, 'sample')}${s.reasons.length < s.reasonCount ? `, the first ${s.reasons.length} of ${count(s.reasonCount)} reasons` : ''}`, ['what', 'why', '#times', 'first in sample'], s.reasons.map((row) => [row.path, row.why, count(row.times), row.example])));
  }
  const lines = (title, list, all) => { if (list.length > 0) parts.push(make('div', {}, make('h3', {}, all > list.length ? `${title} (${list.length} of ${count(all)})` : title), make('ul', {}, ...list.map((line) => make('li', {}, line))))); };
  lines('What could not be read', model.notes, model.noteCount);
  lines('Warnings of the renderer', data.warnings, data.warningCount);
  at('check-list').append(...parts);
}

if (model.layers.length > 0 && model.pictures.length > 0) { sheet(); viewer(); chooseLayer(chosen); } else at('pictures-note').textContent = 'The dataset has no pictures of pixels.';
plans();
distributions();
objects();
frames();
checks();
window.dgtkReport = { model, blockOf, unpack, ready: performance.now() };
})();
