// The box that one shadow map has to cover, for renderers that leave that to their caller.

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const scaled = (a, s) => a.map((v) => v * s);
const sum = (a, b) => a.map((v, i) => v + b[i]);
const unit = (a) => scaled(a, 1 / Math.hypot(...a));

// The half-spaces {p: dot(normal, p) + offset >= 0} that bound the box of `bounds`.
function boxPlanes({ min, max }) {
  return [0, 1, 2].flatMap((i) => {
    const axis = [0, 1, 2].map((k) => (k === i ? 1 : 0));
    return [{ normal: axis, offset: -min[i] }, { normal: scaled(axis, -1), offset: max[i] }];
  });
}

function frustumPlanes(camera, aspect) {
  const tanY = Math.tan((camera.fovY * Math.PI) / 360), tanX = tanY * aspect;
  const right = cross(camera.forward, camera.up);
  const through = (normal, point) => ({ normal, offset: -dot(normal, point) });
  const side = (axis, tan) => through(sum(scaled(camera.forward, tan), axis), camera.eye);
  return [through(camera.forward, sum(camera.eye, scaled(camera.forward, camera.near))),
    side(right, tanX), side(scaled(right, -1), tanX), side(camera.up, tanY), side(scaled(camera.up, -1), tanY)];
}

// The part of a polygon in a half-space.
function clip(polygon, { normal, offset }) {
  const kept = [];
  polygon.forEach((p, i) => {
    const q = polygon[(i + 1) % polygon.length];
    const a = dot(normal, p) + offset, b = dot(normal, q) + offset;
    if (a >= 0) kept.push(p);
    if (a >= 0 !== b >= 0) kept.push(sum(p, scaled(sum(q, scaled(p, -1)), a / (a - b))));
  });
  return kept;
}

// A square in the plane, wide enough to reach beyond the scene.
function plate({ normal, offset }, reach) {
  const n = unit(normal), center = scaled(n, -offset / Math.hypot(...normal));
  const u = unit(cross(n, Math.abs(n[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0])), v = cross(n, u);
  return [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x, y]) =>
    sum(center, sum(scaled(u, x * reach), scaled(v, y * reach))));
}

// The corners of the part of the bounds that the camera sees.
function seenCorners(setup) {
  const planes = [...boxPlanes(setup.bounds), ...frustumPlanes(setup.camera, setup.width / setup.height)];
  const all = [...setup.bounds.min, ...setup.bounds.max, ...setup.camera.eye];
  const reach = 8 * Math.max(1, ...all.map(Math.abs));
  const corners = planes.flatMap((plane) =>
    planes.reduce((polygon, other) => (other === plane ? polygon : clip(polygon, other)), plate(plane, reach)));
  if (corners.length === 0) throw new Error('the camera sees nothing of the scene');
  return corners;
}

function cornersOf({ min, max }) {
  return [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [0, 1, 2].map((k) => ((i >> k) & 1 ? max[k] : min[k])));
}

// far: distance of the farthest point that the camera can see, in metres along its axis.
export function farDepth(setup) {
  const { eye, forward, near } = setup.camera;
  return Math.max(...seenCorners(setup).map((p) => dot(forward, p) - dot(forward, eye)), 2 * near) * 1.01;
}

// A square box along the sun's direction: all receivers that the camera sees, with the margin that their discs need,
// and all casters in front of them. center: of its face towards the sun; half: half its width; depth: its length.
export function shadowBox(setup) {
  const z = setup.toLight;
  const x = unit(cross(Math.abs(z[1]) < 0.999 ? [0, 1, 0] : [1, 0, 0], z)), y = cross(z, x);
  const seen = seenCorners(setup);
  const extent = (axis, points) => {
    const along = points.map((p) => dot(axis, p));
    return [Math.min(...along), Math.max(...along)];
  };
  const [lowX, highX] = extent(x, seen), [lowY, highY] = extent(y, seen);
  const [bottom] = extent(z, seen), [, top] = extent(z, cornersOf(setup.bounds));
  const slack = 0.001 * (top - bottom) + 1e-6;
  const depth = top - bottom + 2 * slack;
  const half = Math.max(highX - lowX, highY - lowY) / 2 + depth * setup.tanHalfSun;
  const center = sum(sum(scaled(x, (lowX + highX) / 2), scaled(y, (lowY + highY) / 2)), scaled(z, top + slack));
  return { center, half, depth };
}
