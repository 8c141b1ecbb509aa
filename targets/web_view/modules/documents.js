// What the server tells the page: the documents of `burnish view`, and word of every change.
/** The document of a choice; `further` are names and values of the query besides. */
export async function fetchDocument(choice, profile, further) {
    const asked = new URLSearchParams([["profile", profile], ...further]);
    for (const [name, value] of Object.entries(choice))
        if (value)
            asked.set(name, value);
    const answer = await fetch(`/document?${asked}`);
    if (!answer.ok)
        throw new Error(`The server answered: ${answer.status} ${await answer.text()}`);
    return (await answer.json());
}
/** The files of the folder that is shown; none, if it is a single file. */
export async function fetchFiles() {
    const answer = await fetch("/files");
    return answer.ok ? (await answer.json()) : [];
}
/** Calls `changed` with a file and its version, now and after each change; `connected` is told
 * whether the server is there. */
export function listen(changed, connected) {
    const source = new EventSource("/changes");
    source.onopen = () => connected(true);
    source.onerror = () => connected(false);
    source.onmessage = (event) => {
        const { file, version } = JSON.parse(event.data);
        changed(file, version);
    };
}
