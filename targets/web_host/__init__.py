"""A host for web pages, in JavaScript, and what makes the packages that it draws."""
