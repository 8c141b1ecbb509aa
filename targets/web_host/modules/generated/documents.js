// Generated from the records of compiler/documents and documents.py by the tests: do not edit.
export {};
