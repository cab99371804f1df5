// The page's elements.

export const byId = (id) => document.getElementById(id);
