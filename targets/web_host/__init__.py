"""A host for web pages, in TypeScript, and what makes the packages that it draws."""
