// The documents that a host reads: a frame's package, its plan, and the reflections of its shaders.
// docs/hosts.md, docs/plans.md and docs/reflection.md explain them; here stands what the host uses.
export {};
