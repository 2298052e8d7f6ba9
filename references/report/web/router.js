// The address of what is shown: #scene=KEY&view=MODE&pixel=X,Y; without a scene it is the overview.

export function place() {
  const values = new URLSearchParams(location.hash.slice(1));
  const [x, y] = (values.get("pixel") ?? "").split(",").map(Number);
  const pixel = Number.isInteger(x) && Number.isInteger(y) && x >= 0 && y >= 0 && values.has("pixel") ? {x, y} : null;
  return {scene: values.get("scene"), view: values.get("view"), pixel};
}

export function address({scene, view, pixel}) {
  const values = new URLSearchParams({scene});
  if (view) values.set("view", view);
  if (pixel) values.set("pixel", `${pixel.x},${pixel.y}`);
  return `#${values}`;
}

/** Keeps the address true without a step in the history. */
export function remember(where) {
  history.replaceState(null, "", address(where));
}
