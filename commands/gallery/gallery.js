// The script of a gallery's pages: it filters cards by words and kinds, and shows one text of many.
"use strict";

/** Shows the cards that have all the words and the kind; the address remembers both. */
function filterCards() {
  const search = document.getElementById("search");
  const cards = [...document.querySelectorAll(".cards > li")];
  const chips = [...document.querySelectorAll("[data-kind]")];
  const asked = new URLSearchParams(location.hash.slice(1));
  let kind = chips.some((chip) => chip.dataset.kind === asked.get("kind")) ? asked.get("kind") : "";
  search.value = asked.get("words") ?? "";

  function show() {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    let count = 0;
    for (const card of cards) {
      const fits = words.every((word) => card.dataset.words.includes(word))
        && (!kind || card.dataset.kinds.split(" ").includes(kind));
      card.hidden = !fits;
      count += fits;
    }
    for (const group of document.querySelectorAll(".group")) {
      group.hidden = !group.querySelector("li:not([hidden])");
    }
    for (const chip of chips) chip.setAttribute("aria-pressed", String(chip.dataset.kind === kind));
    document.getElementById("found").value = count < cards.length ? `${count} of ${cards.length}` : "";
    document.getElementById("nothing").hidden = count > 0;
    const state = new URLSearchParams();
    if (search.value) state.set("words", search.value);
    if (kind) state.set("kind", kind);
    history.replaceState(null, "", `#${state}`);
  }
  search.addEventListener("input", show);
  for (const chip of chips) chip.addEventListener("click", () => { kind = chip.dataset.kind; show(); });
  if (search.value || kind) show();
}

/** Shows one panel of a section at a time: a list chooses the program, buttons its stage. */
function showOneOfMany(section) {
  const panels = [...section.querySelectorAll(".panel")];
  const groups = [...new Set(panels.map((panel) => panel.dataset.group))];
  if (panels.length < 2) return;
  const tabs = document.createElement("div");
  tabs.className = "tabs";
  const list = document.createElement("select");
  list.setAttribute("aria-label", "Program");
  list.append(...groups.map((group) => new Option(group, group)));
  list.hidden = groups.length < 2;
  const buttons = document.createElement("span");
  buttons.setAttribute("role", "tablist");
  buttons.className = "tabs";
  tabs.append(list, buttons);
  section.querySelector("h2").after(tabs);
  section.classList.add("ready");
  let tab = null;

  function show() {
    const own = panels.filter((panel) => panel.dataset.group === list.value);
    const chosen = own.find((panel) => panel.dataset.tab === tab) ?? own.at(-1);
    buttons.replaceChildren(...own.filter((panel) => panel.dataset.tab).map((panel) => {
      const button = document.createElement("button");
      button.type = "button";
      button.setAttribute("role", "tab");
      button.setAttribute("aria-selected", String(panel === chosen));
      button.textContent = panel.dataset.tab;
      button.addEventListener("click", () => { tab = panel.dataset.tab; show(); });
      return button;
    }));
    for (const panel of panels) panel.hidden = panel !== chosen;
  }
  list.addEventListener("change", show);
  show();
}

if (document.getElementById("search")) filterCards();
for (const section of document.querySelectorAll("[data-tabs]")) showOneOfMany(section);
