// Generated from the records of documents (compiler/documents, documents.py) by the tests: do not edit.
export {};
