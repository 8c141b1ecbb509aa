// The pictures that somebody gives textures: files go to the server, which knows each by a word.

import type { Control } from "./documents.js";
import { make } from "./elements.js";

/** Before the word of a picture whose colours are sRGB. */
const SRGB = "srgb:";
/** What a browser offers to choose from. */
const KINDS = "image/png,image/jpeg,image/webp,image/*,.hdr,.exr";

/** What of a texture's control this module reads. */
export type TextureControl = Control & { dimension: string; sample: string };

export const isTexture = (control: Control): control is TextureControl =>
  control.kind === "texture";

/** The pictures of what is shown, and for as long as the tab is open, those of all else. */
export class Pictures {
  /** By the texture's name, what is asked of the server. */
  private asked: Record<string, string> = {};
  private key: string | null = null;
  /** By the word of a picture, what it looks like. */
  private readonly looks = new Map<string, string>();

  /** `changed` is called when the server has to be asked again. */
  constructor(private readonly changed: () => void) {}

  /** What to ask the server for, by names of a query. */
  get query(): [string, string][] {
    return Object.entries(this.asked).map(([name, word]) => [`picture.${name}`, word]);
  }

  /** Go on with the pictures of something, by its name. Returns whether they are others than those
   * that were asked for. */
  enter(key: string): boolean {
    if (key === this.key) return false;
    const before = JSON.stringify(this.asked);
    this.key = key;
    this.asked = load(key);
    return JSON.stringify(this.asked) !== before;
  }

  /** Give a texture the picture of a file. An error says why that cannot be. */
  async give(control: TextureControl, file: File, mostBytes: number): Promise<void> {
    if (file.size > mostBytes) {
      const [size, most] = [megabytes(file.size), megabytes(mostBytes)];
      throw new Error(`${file.name} has ${size}, and may have ${most}`);
    }
    const { dimension, sample } = control;
    const query = new URLSearchParams({ name: file.name, dimension, sample });
    const answer = await fetch(`/picture?${query}`, { method: "POST", body: file });
    const said = await answer.text();
    if (!answer.ok) throw new Error(said);
    if (file.type.startsWith("image/")) this.looks.set(said, URL.createObjectURL(file));
    // A map whose default is a normal holds numbers; else a picture most likely shows colours.
    const isColor = control.picture?.is_srgb ?? String(control.value) !== "flat_normal";
    this.ask(control.name, `${isColor ? SRGB : ""}${said}`);
  }

  setSrgb(name: string, isSrgb: boolean): void {
    this.ask(name, `${isSrgb ? SRGB : ""}${this.word(name)}`);
  }

  drop(name: string): void {
    if (!(name in this.asked)) return;
    delete this.asked[name];
    this.keep();
  }

  /** The address of what the picture of a texture looks like, if the page knows that. */
  look(name: string): string | null {
    return this.looks.get(this.word(name)) ?? null;
  }

  private word(name: string): string {
    return (this.asked[name] ?? "").replace(SRGB, "");
  }

  private ask(name: string, word: string): void {
    this.asked[name] = word;
    this.keep();
  }

  private keep(): void {
    try {
      sessionStorage.setItem(storageKey(this.key), JSON.stringify(this.asked));
    } catch {
      // The browser keeps nothing: then pictures last as long as the page.
    }
    this.changed();
  }
}

/** The field of a texture: what it has now, a button to choose another picture, and what is wrong
 * with the one that was chosen last. */
export function textureField(
  control: TextureControl, label: string, pictures: Pictures, give: (file: File) => Promise<void>,
): HTMLElement {
  const { name, picture } = control;
  const chooser = make("input", { type: "file", accept: KINDS, class: "hidden", tabindex: -1 });
  const button = make("button", { type: "button", "aria-describedby": label }, "Choose…");
  button.addEventListener("click", () => chooser.click());
  chooser.addEventListener("change", () => {
    const [file] = chooser.files ?? [];
    if (file) void give(file);
    chooser.value = "";
  });
  const given = control.is_given ? "A picture" : `All ${String(control.value)}`;
  const look = pictures.look(name);
  const shown = look ? make("img", { src: look, alt: "", class: "look" }) : "";
  const called = make("span", { class: "file" }, picture?.file ?? given);
  const line = make("div", { class: "pick" }, shown, called, button);
  const element = make("div", { class: "texture" }, line, chooser);
  if (picture && !picture.is_float && control.sample === "float") {
    const box = make("input", { type: "checkbox", checked: picture.is_srgb });
    box.addEventListener("change", () => pictures.setSrgb(name, box.checked));
    element.append(make("label", {}, box, " Its colours are sRGB"));
  }
  return element;
}

const megabytes = (bytes: number) => `${Math.ceil(bytes / 2 ** 20)} MB`;
const storageKey = (key: string | null) => `pictures of ${key ?? ""}`;

function load(key: string): Record<string, string> {
  try {
    return JSON.parse(sessionStorage.getItem(storageKey(key)) ?? "{}") as Record<string, string>;
  } catch {
    return {};
  }
}
