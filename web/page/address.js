// The view as the address' fragment, for links: #x=..&y=..&scale=..&rotate=..&tilt=..&view=..&split=..&ground=..

export function readAddress() {
  const given = new URLSearchParams(location.hash.slice(1)), numbers = {};
  for (const name of ['x', 'y', 'scale', 'rotate', 'tilt', 'split']) {
    const number = Number.parseFloat(given.get(name));
    if (Number.isFinite(number))
      numbers[name] = number;
  }
  return {...numbers, view: given.get('view') ?? 'picture', ground: given.get('ground') ?? 'white'};
}

let timer = 0;
export function writeAddress(state) {
  clearTimeout(timer);
  timer = setTimeout(() => {
    const parts = Object.entries(state).filter(([, value]) => value !== null)
      .map(([name, value]) => `${name}=${typeof value === 'number' ? Number(value.toPrecision(10)) : value}`);
    try {
      history.replaceState(null, '', '#' + parts.join('&'));
    } catch {
      // Some browsers refuse it to pages without an origin.
    }
  }, 400);
}
