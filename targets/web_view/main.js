// The page of `burnish view`: connects the server's documents, the controls and the picture.

import { PROFILES } from "../web_host/host.js";
import { present } from "../web_host/present.js";
import { chosenApi, NO_API, TITLES } from "./apis.js";
import { fetchDocument, listen } from "./documents.js";
import { BufferView } from "./buffers.js";
import { takeDrops } from "./drops.js";
import { element, make } from "./elements.js";
import { FileList } from "./files.js";
import { follow } from "./gestures.js";
import { showIn } from "./messages.js";
import { Panel } from "./panel.js";
import { Pictures } from "./pictures.js";
import { Screen } from "./screen.js";
import { showTextsOf } from "./texts.js";

/**
 * @import { Api } from "../web_host/host.js"
 * @import { Choice, Document, Drawable } from "./documents.js"
 * @import { Status } from "./screen.js"
 */

const canvas = element("picture", HTMLCanvasElement);
const problem = element("problem", HTMLElement);
const selects = {
  subject: element("subject", HTMLSelectElement),
  rig: element("rig", HTMLSelectElement),
  pass: element("pass", HTMLSelectElement),
  mesh: element("mesh", HTMLSelectElement),
};
const outputs = element("output", HTMLSelectElement);
const play = element("play", HTMLButtonElement);

/**
 * The choice that the page shows; it is in the page's address, too, for bookmarks.
 * @type {Choice}
 */
const choice = { file: null, subject: null, rig: null, pass: null, mesh: null, output: null };
/** @type {Drawable | null} */
let shown = null;
/** The errors of the source, and those of drawing it. */
const problems = { source: "", picture: "" };

function tellProblems() {
  const text = problems.source || problems.picture;
  problem.hidden = !text;
  showIn(element("message", HTMLPreElement), text);
}

/** @param {Api} api */
function view(api) {
  const screen = new Screen(canvas, api, {
    problem(text) {
      if (text === problems.picture) return;
      problems.picture = text;
      tellProblems();
    },
    drawn(status) {
      buffer.hide();
      tellStatus(status);
    },
    written(layout, bytes) {
      buffer.show(layout, bytes);
      tellStatus(null);
    },
    runs: () => panel?.runs ?? false,
    elapsed: (seconds) => panel?.advance(seconds),
  });
  const buffer = new BufferView();
  const pictures = new Pictures(() => void load());
  /** @type {Panel | null} */
  let panel = null;

  /**
   * @param {Document} found
   * @returns {Promise<void>}
   */
  async function showDocument(found) {
    fillSelects(found);
    problems.source = found.error ?? "";
    if (found.error === undefined) {
      panel ??= new Panel(
        element("controls", HTMLElement),
        (name, value) => screen.set(name, value), () => screen.request(), pictures,
      );
      const before = shown;
      shown = found;
      Object.assign(choice, found.chosen);
      const values = panel.show(nameOf(found), found.controls, found.most_bytes);
      fillOutputs(found);
      showTextsOf(found.package);
      try {
        await screen.open(found, values, outputs.value);
        problems.picture = "";
      } catch (error) {
        problems.picture = /** @type {Error} */ (error).message;
      }
      if (!before || nameOf(before) !== nameOf(found)) describe(found);
      element("time", HTMLElement).hidden = !(
        screen.evolves || found.controls.some((control) => control.is_timed)
      );
    }
    tellProblems();
    files.show(found.file);
    document.body.dataset.file = found.file;
    document.body.dataset.version = found.version;
    document.body.dataset.ready = problems.source || problems.picture ? "no" : "yes";
  }

  // One document is loaded at a time; after it, the latest choice that was made meanwhile.
  let loading = false;
  let again = false;
  /** @returns {Promise<void>} */
  async function load() {
    again = true;
    if (loading) return;
    loading = true;
    try {
      while (again) {
        again = false;
        const found = await fetchDocument(choice, PROFILES[api], pictures.query);
        if (found.error === undefined) {
          again ||= pictures.enter(nameOf(found));
        }
        if (!again) await showDocument(found);
      }
    } catch (error) {
      problems.source = /** @type {Error} */ (error).message;
      tellProblems();
    } finally {
      loading = false;
    }
  }

  listen(
    (file, version) => {
      const own = document.body.dataset;
      const isOther = own.file === file ? version !== own.version
        : serverOf(version) !== serverOf(own.version ?? "");
      if (isOther) void load();
    },
    (isConnected) => { element("gone", HTMLElement).hidden = isConnected; },
  );
  follow(canvas, () => screen.orbit, () => screen.request());
  takeDrops(() => panel, notify);
  const files = new FileList((name) => {
    Object.assign(choice, { file: name, subject: null, rig: null, pass: null, output: null });
    remember();
    void load();
  });
  void files.load();
  void load();

  for (const [name, select] of Object.entries(selects)) {
    select.addEventListener("change", () => {
      choice[/** @type {keyof Choice} */ (name)] = select.value;
      // Another subject begins with the rig, the pass and the output of its own.
      if (name === "subject") choice.pass = choice.output = null;
      remember();
      void load();
    });
  }
  outputs.addEventListener("change", () => {
    choice.output = outputs.value;
    remember();
    screen.show(outputs.value);
  });
  element("scale", HTMLSelectElement).addEventListener("change", (event) => {
    screen.scale = Number(/** @type {HTMLSelectElement} */ (event.target).value);
    screen.request();
  });

  /** @type {Record<string, () => void>} */
  const acts = {
    home: () => (screen.showsBuffer ? buffer.home() : screen.resetCamera()),
    play: () => {
      screen.playing = !screen.playing;
      play.setAttribute("aria-pressed", String(!screen.playing));
      screen.request();
    },
    step: () => screen.step(),
    restart: () => {
      if (shown) void showDocument(shown);
    },
    save: () => void saved(screen.showsBuffer ? buffer : screen),
    defaults: () => panel?.resetAll(),
    copy: () => void navigator.clipboard.writeText(panel?.options ?? ""),
  };
  for (const [id, act] of Object.entries(acts)) {
    element(id, HTMLButtonElement).addEventListener("click", act);
  }
  /** @type {Record<string, string>} */
  const keys = { h: "home", " ": "play", ".": "step", r: "restart", s: "save" };
  element("stage", HTMLElement).addEventListener("keydown", (event) => {
    const isPicture = event.target instanceof HTMLCanvasElement;
    const name = keys[event.key.toLowerCase()];
    if (!isPicture || !name || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    acts[name]();
  });
}

/** The name under which the values of a subject are kept. @type {(shown: Drawable) => string} */
const nameOf = ({ file, chosen }) => `${file}/${chosen.subject}`;

/** The part of a version that names the server's run. @type {(version: string) => string} */
const serverOf = (version) => version.split(".")[0];

/**
 * Show a message for a few seconds.
 * @param {string} text
 */
function notify(text) {
  const place = element("notice", HTMLElement);
  place.textContent = text;
  place.hidden = false;
  clearTimeout(Number(place.dataset.timer));
  place.dataset.timer = String(setTimeout(() => { place.hidden = true; }, 4000));
}

/** Write the choice into the page's address. */
function remember() {
  const said = Object.entries(choice).filter(([, value]) => value);
  const asked = new URLSearchParams(/** @type {[string, string][]} */ (said));
  history.replaceState(null, "", `?${asked}`);
}

/**
 * Show the size of the picture and the frames per second; null if no picture is shown.
 * @param {Status | null} status
 */
function tellStatus(status) {
  const magnified = Number(status?.magnified.toPrecision(2));
  const size = status ? `${status.width} × ${status.height}` : "";
  element("size", HTMLElement).textContent =
    size && size + (magnified === 1 ? "" : ` at ${magnified}×`);
  const rate = status?.rate ?? null;
  element("rate", HTMLElement).textContent = rate === null ? "" : `${Math.round(rate)} fps`;
  canvas.dataset.drawn = String(Number(canvas.dataset.drawn ?? 0) + 1);
}

/**
 * Fill the lists with the choices of the file.
 * @param {Document} found
 */
function fillSelects(found) {
  document.title = `${found.file} · Burnish`;
  element("file", HTMLElement).textContent = found.file;
  const chosen = found.error === undefined ? found.chosen : choice;
  fill(selects.subject, found.subjects.map(({ name }) => name), chosen.subject);
  fill(selects.rig, found.rigs, chosen.rig);
  const isFrame = found.subjects.find(({ name }) => name === chosen.subject)?.kind === "frame";
  fill(selects.pass, isFrame ? [] : found.passes, chosen.pass);
  if (found.error === undefined) fill(selects.mesh, found.meshes, chosen.mesh);
}

/** @param {Drawable} found */
function fillOutputs(found) {
  const names = found.package.plan.outputs.map(({ name }) => name);
  const asked = choice.output ?? outputs.value;
  fill(outputs, names, names.includes(asked) ? asked : (names[0] ?? null));
}

/**
 * The options of a list, which is hidden where there is nothing to choose.
 * @param {HTMLSelectElement} select
 * @param {string[]} names
 * @param {string | null} chosen
 */
function fill(select, names, chosen) {
  const known = [...select.options].map(({ value }) => value);
  if (known.join("\n") !== names.join("\n")) {
    select.replaceChildren(...names.map((name) => make("option", { value: name }, name)));
  }
  if (chosen !== null) select.value = chosen;
  present(select.closest("label")).hidden = names.length < 2;
}

/** @param {Drawable} found */
function describe(found) {
  element("title", HTMLElement).textContent = found.chosen.subject;
  const doc = element("doc", HTMLElement);
  doc.textContent = found.doc;
  doc.hidden = !found.doc;
  canvas.setAttribute("aria-label", `${found.chosen.subject}: drag or press arrow keys to turn`);
}

/**
 * Offer the picture as a file to keep.
 * @param {{ picture(): Promise<Blob> }} screen
 * @returns {Promise<void>}
 */
async function saved(screen) {
  const link = make("a", { download: `${choice.subject ?? "picture"}.png` });
  link.href = URL.createObjectURL(await screen.picture());
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

for (const [name, value] of new URLSearchParams(location.search)) {
  if (name in choice) choice[/** @type {keyof Choice} */ (name)] = value;
}
const api = await chosenApi();
if (api) {
  element("api", HTMLElement).textContent = TITLES[api];
  view(api);
} else {
  problems.picture = NO_API;
  tellProblems();
}
