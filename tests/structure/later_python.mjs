// Runs a program in Pyodide, which is a later CPython, and prints its last value.
//
// Arguments: the path of Pyodide, the program, and then pairs of a place and the folder that is seen
// there.

const [path, program, ...folders] = process.argv.slice(2);
const { loadPyodide } = await import(path);
const python = await loadPyodide();
for (let at = 0; at < folders.length; at += 2) {
  python.FS.mkdir(folders[at]);
  python.mountNodeFS(folders[at], folders[at + 1]);
}
console.log(python.runPython(program));
