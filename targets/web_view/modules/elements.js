// Makes elements of the page.
/** An element with attributes, and what is inside it. `true` is an attribute without a value;
 * `false` and `null` are none. */
export function make(tag, attributes = {}, ...inside) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (value === false || value === null)
            continue;
        made.setAttribute(name, value === true ? "" : String(value));
    }
    made.append(...inside);
    return made;
}
/** The element of the page with an id. */
export function element(id, kind) {
    const found = document.getElementById(id);
    if (!(found instanceof kind))
        throw new Error(`The page has no ${kind.name} called ${id}.`);
    return found;
}
