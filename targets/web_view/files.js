// The list of a folder's files, from which somebody chooses what is shown.

import { present } from "../web_host/present.js";
import { fetchFiles } from "./documents.js";
import { element, make } from "./elements.js";

/** @import { Group } from "./documents.js" */

const place = element("files", HTMLElement);
const list = element("file-list", HTMLElement);
const search = element("file-search", HTMLInputElement);
const opener = element("open-files", HTMLButtonElement);

export class FileList {
  /** @type {Group[]} */
  #groups = [];
  #current = "";
  #built = "";

  #choose;

  /**
   * `choose` is called with the name of a file.
   * @param {(name: string) => void} choose
   */
  constructor(choose) {
    this.#choose = choose;
    search.addEventListener("input", () => this.#filter());
    opener.addEventListener("click", () => this.#toggle());
    // Files come and go while the page is not looked at.
    window.addEventListener("focus", () => void this.load());
  }

  /**
   * Ask which files there are now.
   * @returns {Promise<void>}
   */
  async load() {
    const groups = await fetchFiles().catch(() => this.#groups);
    const known = JSON.stringify(groups);
    if (known === this.#built) return;
    this.#built = known;
    this.#groups = groups;
    opener.hidden = !groups.length;
    place.hidden = !groups.length || narrow.matches;
    opener.setAttribute("aria-expanded", String(!place.hidden));
    list.replaceChildren(...groups.flatMap((group) => this.#group(group)));
    this.#filter();
    this.show(this.#current);
  }

  /**
   * Mark the file that is shown.
   * @param {string} name
   */
  show(name) {
    this.#current = name;
    for (const link of list.querySelectorAll("a")) {
      const isCurrent = link.dataset.name === name;
      if (isCurrent) link.setAttribute("aria-current", "page");
      else link.removeAttribute("aria-current");
      if (isCurrent) link.scrollIntoView({ block: "nearest" });
    }
  }

  /**
   * @param {Group} group
   * @returns {HTMLElement[]}
   */
  #group({ title, files }) {
    const links = files.map(({ name, what, subjects }) => {
      const link = make("a", { href: `?${new URLSearchParams({ file: name })}` },
        make("span", { class: "what" }, ...marked(capital(what) || name)),
        make("span", { class: "names" }, [...(what ? [name] : []), ...subjects].join(" · ")),
      );
      link.dataset.name = name;
      link.dataset.words = [title, name, what, ...subjects].join(" ").toLowerCase();
      link.addEventListener("click", (event) => {
        // A new tab or window opens the address instead.
        if (event.ctrlKey || event.metaKey || event.shiftKey) return;
        event.preventDefault();
        if (narrow.matches) this.#toggle();
        this.#choose(name);
      });
      return link;
    });
    const section = make("section", {}, ...(title ? [make("h2", {}, title)] : []), ...links);
    return [section];
  }

  #filter() {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    for (const section of list.querySelectorAll("section")) {
      const links = [...section.querySelectorAll("a")];
      for (const link of links) {
        link.hidden = !words.every((word) => present(link.dataset.words).includes(word));
      }
      section.hidden = links.every((link) => link.hidden);
    }
  }

  #toggle() {
    place.hidden = !place.hidden;
    opener.setAttribute("aria-expanded", String(!place.hidden));
  }
}

/** Matches narrow windows, in which the list covers the page. */
const narrow = window.matchMedia("(max-width: 720px)");

/** @type {(text: string) => string} */
const capital = (text) => text.slice(0, 1).toUpperCase() + text.slice(1);

/** A text in which backticks mark code. @type {(text: string) => (string | Node)[]} */
const marked = (text) =>
  text.split("`").map((piece, at) => (at % 2 ? make("code", {}, piece) : piece));
