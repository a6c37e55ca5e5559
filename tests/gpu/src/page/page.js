const DATA = JSON.parse(document.getElementById("data").textContent);
const main = document.getElementById("main");
const side = document.getElementById("side");
const list = document.getElementById("list");
const filter = document.getElementById("filter");
const CRATES = { noise: "asperity-noise", ndf: "asperity-ndf-sampling", shading: "asperity-shading", fif: "asperity-fif" };
const BY_NAME = new Map(DATA.parts.map(part => [part.name, part]));
let engine = "wgpu";

// An element with attributes and children; texts are texts, never HTML.
function make(tag, attributes, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children.flat().filter(child => child !== null && child !== undefined && child !== false));
  return element;
}

// Words in backticks are code.
const prose = text => text.split("`").map((piece, i) => (i % 2 ? make("code", {}, piece) : piece));

const WORDS = {
  wgsl: "fn let var const struct return if else for while loop switch case default break continue true false alias import",
  rust: "use let fn pub struct impl for static const mut move return if else match self Self true false derive in as",
  js: "import from const let function return await async new for of if else typeof as export class",
  gdscript: "extends const var func return for if not else in and or class",
  hlsl: "Shader SubShader Pass HLSLPROGRAM ENDHLSL struct return float float2 float3 float4 static const uint int void",
  csharp: "using public class readonly static void var new return byte string int ref out",
  swift: "import let var func try return throws struct nil",
};

// Keywords, types, numbers and comments; nothing more.
function highlighted(text, language) {
  const comment = language === "gdscript" ? "#[^\\n]*" : "//[^\\n]*";
  const words = (WORDS[language] || "").split(" ").join("|");
  const pattern = new RegExp(
    `(${comment})|("(?:[^"\\\\\\n]|\\\\.)*")|\\b(${words})\\b|\\b([A-Z]\\w*|[fiu]32|u64|f64|vec[234]|mat[234]x[234]|array|texture_2d|sampler|bool)\\b|\\b(0x[0-9a-fA-F]+u?|\\d[\\d.]*(?:e[-+]?\\d+)?[fiu]?)\\b`, "g");
  const pieces = [];
  let at = 0;
  for (const match of text.matchAll(pattern)) {
    pieces.push(text.slice(at, match.index));
    const kind = match[1] ? "c" : match[2] ? "n" : match[3] ? "k" : match[4] ? "t" : "n";
    pieces.push(make("span", { class: kind }, match[0]));
    at = match.index + match[0].length;
  }
  pieces.push(text.slice(at));
  return pieces;
}

function box(title, text, language) {
  const copy = make("button", { class: "copy", type: "button", onclick: async () => {
    try {
      await navigator.clipboard.writeText(text);
      copy.textContent = "Copied";
    } catch {
      getSelection().selectAllChildren(code);
      copy.textContent = "Selected";
    }
    setTimeout(() => { copy.textContent = "Copy"; }, 1500);
  } }, "Copy");
  const code = make("code", {}, highlighted(text, language));
  return make("div", { class: "box" }, make("div", { class: "bar" }, make("span", {}, title), copy), make("pre", { tabindex: "0" }, code));
}

const link = name => make("a", { href: "#" + name }, name);
const encoded = path => path.split("/").map(encodeURIComponent).join("/");

function fileLinks(folder, dialects) {
  return dialects.map(([label, file]) => make("li", {}, make("a", { href: `${encoded(folder)}/${file}` }, label)));
}

function bindingRows(part) {
  const size = b => (b.words ? [`${b.words} words`, b.kind === "table" ? `${b.width} × ${b.height} texels` : `${4 * b.words} bytes`] : []);
  return part.bindings.map(b => make("tr", {},
    make("td", {}, `0, ${b.binding}`),
    make("td", {}, make("code", {}, b.kind === "table" ? `${b.name}_table` : b.name)),
    make("td", {}, b.kind === "table" ? "texture, unfiltered" : b.kind, b.holds ? [", ", make("code", {}, b.holds)] : null),
    make("td", { class: "size" }, size(b).map(text => make("div", {}, text)),
      b.words ? make("a", { href: `${encoded("parts/" + part.name)}/${b.name}.bin`, download: "" }, "file of the sample") : null),
    make("td", { class: "fill" }, make("code", {}, b.fill))));
}

function samples(part) {
  const shown = make("div", {});
  const tabs = ENGINES.map(of => make("button", { type: "button", role: "tab", onclick: () => show(of) }, of.name));
  function show(of) {
    engine = of.name;
    tabs.forEach((tab, i) => tab.setAttribute("aria-selected", ENGINES[i] === of));
    shown.replaceChildren(
      make("span", { class: "quiet said" }, prose(of.said)),
      ...of.text(part).map(([title, text, language]) => box(title || part.name, text, language || of.language)));
  }
  show(ENGINES.find(of => of.name === engine));
  return [make("div", { class: "tabs", role: "tablist", "aria-label": "Engines" }, tabs), shown];
}

function partView(part) {
  const folder = "parts/" + part.name;
  const users = DATA.parts.filter(other => other.needs.includes(part.name));
  const entries = DATA.entries.filter(entry => part.called.includes(entry.name));
  const path = part.name.split("/");
  return [
    make("h1", {}, make("small", {}, `${CRATES[path[0]]} › ${path.slice(1, -1).join(" › ") || path[0]}`), path.at(-1)),
    make("p", { class: "lead" }, prose(part.summary)),
    make("p", { class: "quiet" }, "In Rust ", make("code", {}, `asperity_shaders::${part.rust}`)),
    part.needs.length ? [make("h2", {}, "Needs"), make("ul", { class: "plain" }, part.needs.map(name => make("li", {}, link(name))))] : null,
    users.length ? [make("h2", {}, "Needed by"), make("ul", { class: "plain" }, users.map(of => make("li", {}, link(of.name))))] : null,
    make("h2", {}, "Source"),
    box(`${part.name}.wgsl, without what it needs`, part.source, "wgsl"),
    make("h2", {}, "Bindings"),
    part.bindings.length
      ? [make("div", { class: "scroll" }, make("table", {},
          make("thead", {}, make("tr", {}, ["group, binding", "name", "kind", "size", "filled in Rust by"].map(text => make("th", {}, text)))),
          make("tbody", {}, bindingRows(part)))),
        make("p", { class: "quiet" }, "Of the part with all that it needs, as ", make("code", {}, "compose"), " numbers them. Files hold words of 32 bits, the lowest byte first."),
        part.own.length && part.bindings.some(b => b.part.startsWith("case/"))
          ? make("p", { class: "quiet" }, "Uniforms that hold a structure for a function's argument are yours to name; here they are those of the sample.") : null]
      : make("p", {}, "None: its functions take all that they need."),
    part.function ? [
      make("h2", {}, "Files"),
      make("p", {}, "A fragment shader that shows ", make("code", {}, part.function), " over a square, with the part and all that it needs:"),
      make("ul", { class: "plain" }, fileLinks(folder, DATA.dialects),
        make("li", {}, make("a", { href: `${encoded(folder)}/compute.spv` }, "compute shader, SPIR-V")),
        make("li", {}, make("a", { href: `${encoded(folder)}/bevy.wgsl` }, "module for Bevy"))),
      make("h2", {}, "Use"), samples(part),
    ] : [make("h2", {}, "Use"), make("p", {}, "It holds structures, or functions that take what other parts make; the calls in the tests show how.")],
    entries.length ? [
      make("h2", {}, "Called in the tests"),
      make("p", {}, "Bodies of the shaders by which the functions are compared with the crates', with these as files:"),
      entries.map(entry => [
        box(entry.name, entry.body.replace(/^ {4}/gm, "").trim(), "wgsl"),
        make("ul", { class: "plain", style: "margin: 0.4rem 0 1.2rem" }, fileLinks(entry.folder, DATA.dialects)),
      ]),
    ] : null,
  ].flat(4).filter(Boolean);
}

function startView() {
  const bound = DATA.parts.filter(part => part.bindings.some(b => b.part === part.name)).length;
  const start = ["noise/kinds/perlin_2002", "noise/sums/gaussian_octaves_3d", "ndf/density/ggx", "shading/level_of_detail/rule", "shading/material/paint/metallic_paint", "fif/surface/height_field"];
  return [
    make("h1", {}, "Noises, densities, materials and fractal surfaces for graphics cards"),
    make("p", { class: "lead" }, `${DATA.parts.length} parts in plain WGSL, one concept each, and ${DATA.entries.length} shaders by which their functions are compared with the crates', in ${DATA.dialects.map(([label]) => label).join(", ")}.`),
    make("p", {}, `Choose a part: its page has the source, what it is bound to and the Rust values that fill that, files in every language, and a use in ${ENGINES.map(of => of.name).join(", ")}. ${bound} parts are bound to uniforms, tables or textures; files of their words are beside the shaders, so that an engine without Rust has them too.`),
    make("h2", {}, "Begin with"),
    make("ul", {}, start.filter(name => BY_NAME.has(name)).map(name => make("li", {}, link(name)))),
    make("h2", {}, "What was run"),
    make("div", { class: "scroll" }, make("table", {}, make("tbody", {}, ENGINES.map(of => make("tr", {}, make("td", {}, of.name), make("td", {}, prose(of.said))))))),
    make("h2", {}, "Rules of all parts"),
    make("ul", {},
      make("li", {}, "Names begin with their concept and end in no digit, so that parts stand behind one another in one module."),
      make("li", {}, "Tables are textures of one channel, read texel by texel: never filter them, and fill the last row with zeros."),
      make("li", {}, prose("Seeds come as keys: `asperity_shaders::noise::key(seed)`.")),
      make("li", {}, "For zooms beyond 100 anchor sums of octaves at a focus in Rust, and give the shader differences from there."),
      make("li", {}, "Uniforms have the layout that WGSL and std140 share; a part's words are copied as they are.")),
  ];
}

function render() {
  const name = decodeURIComponent(location.hash.slice(1));
  const part = BY_NAME.get(name);
  main.replaceChildren(...(part ? partView(part) : startView()));
  document.title = part ? `${part.name} · Asperity shaders` : "Asperity shaders";
  list.querySelectorAll("a").forEach(a => {
    const here = a.dataset.name === name;
    if (here) a.setAttribute("aria-current", "page"); else a.removeAttribute("aria-current");
    if (here) a.scrollIntoView({ block: "nearest" });
  });
  open(false);
  scrollTo(0, 0);
}

function listed() {
  const words = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
  const matches = part => words.every(word => [part.name, ...part.names].some(name => name.toLowerCase().includes(word)));
  const children = [];
  let crate, room;
  for (const part of DATA.parts.filter(matches)) {
    const path = part.name.split("/");
    if (path[0] !== crate) {
      [crate, room] = [path[0], undefined];
      children.push(make("h2", {}, CRATES[crate] || crate));
    }
    const its = path.slice(1, -1).join(" › ");
    if (its !== room) {
      room = its;
      if (room) children.push(make("h3", {}, room));
    }
    children.push(make("a", { href: "#" + part.name, "data-name": part.name }, path.at(-1)));
  }
  list.replaceChildren(...(children.length ? children : [make("p", {}, "No part or function has this name.")]));
}

function open(is) {
  side.classList.toggle("open", is);
  document.getElementById("menu").setAttribute("aria-expanded", is);
}

// Rooms of a crate stand together.
DATA.parts.sort((a, b) => {
  const order = part => Object.keys(CRATES).indexOf(part.name.split("/")[0]);
  const room = part => part.name.split("/").slice(0, -1).join("/");
  return order(a) - order(b) || room(a).localeCompare(room(b)) || a.name.localeCompare(b.name);
});
document.getElementById("menu").addEventListener("click", () => open(!side.classList.contains("open")));
filter.addEventListener("input", () => { listed(); if (filter.value) open(true); });
addEventListener("hashchange", render);
listed();
render();
