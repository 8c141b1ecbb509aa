// Generated from the JSON Schemas of packages, plans and reflections by the tests: do not edit.
export {};
