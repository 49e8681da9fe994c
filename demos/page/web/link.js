// A moment as the end of the page's address: #t=1.25&camera=main&speed=0.5&overlays=contacts,modes&body=crate. A camera
// that a visitor has moved is "free" and says where: &eye=6,-9,5&target=0,0,1.

const short = x => String(Number(x.toFixed(3)));
const triple = text => {
  const numbers = (text ?? "").split(",").map(Number);
  return numbers.length === 3 && numbers.every(Number.isFinite) ? numbers : null;
};

/** What an address asks for, only as far as it makes sense: { t, camera, eye, target, speed, overlays, body }. */
export function readLink(hash) {
  const asked = new URLSearchParams(hash.replace(/^#/, "")), wanted = {};
  const number = (name, low, high) => {
    const value = asked.has(name) ? Number(asked.get(name)) : NaN;
    if (Number.isFinite(value)) wanted[name] = Math.min(Math.max(value, low), high);
  };
  number("t", 0, Infinity);
  number("speed", 0.1, 4);
  number("fov", 1, 150);
  for (const name of ["camera", "body"]) if (asked.get(name)) wanted[name] = asked.get(name);
  if (asked.has("overlays")) wanted.overlays = asked.get("overlays").split(",").filter(name => name !== "");
  for (const name of ["eye", "target"]) if (triple(asked.get(name))) wanted[name] = triple(asked.get(name));
  return wanted;
}

/** The same the other way round; a comma stays a comma. */
export function writeLink(now) {
  const parts = { t: short(now.t), camera: now.camera };
  if (now.camera === "free") {
    parts.eye = now.eye.map(short).join(",");
    parts.target = now.target.map(short).join(",");
    parts.fov = short(now.fov);
  }
  if (now.speed !== 1) parts.speed = short(now.speed);
  if (now.overlays.length > 0) parts.overlays = now.overlays.join(",");
  if (now.body) parts.body = now.body;
  return "#" + new URLSearchParams(parts).toString().replaceAll("%2C", ",");
}
