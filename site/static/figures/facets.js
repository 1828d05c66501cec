/** Meshes on a canvas, seen along -z. vertices: x, y, z of each, in a row. faces: [a, b, c]. */
import { html } from "./elements.js";

const LIGHT = [-0.45, 0.65, 0.62];

/** A canvas under a sheet, in the screen's pixels -> its context, in the sheet's coordinates. */
export function canvasOf(sheet) {
  const canvas = html("canvas", { "aria-hidden": "true" });
  sheet.box.prepend(canvas);
  sheet.box.classList.add("smooth");
  const context = canvas.getContext("2d");
  return () => {
    canvas.width = Math.round(sheet.box.clientWidth * devicePixelRatio);
    canvas.height = Math.round(sheet.box.clientHeight * devicePixelRatio);
    const scale = canvas.width / (sheet.x1 - sheet.x0);
    context.setTransform(scale, 0, 0, -scale, -sheet.x0 * scale, sheet.y1 * scale);
    context.lineWidth = 1 / scale;
    context.lineJoin = "round";
    return context;
  };
}

function trace(path, vertices, [a, b, c]) {
  path.moveTo(vertices[3 * a], vertices[3 * a + 1]);
  path.lineTo(vertices[3 * b], vertices[3 * b + 1]);
  path.lineTo(vertices[3 * c], vertices[3 * c + 1]);
  path.closePath();
}

function normalOf(vertices, [a, b, c]) {
  const side = (end, axis) => vertices[3 * end + axis] - vertices[3 * a + axis];
  return [side(b, 1) * side(c, 2) - side(b, 2) * side(c, 1),
          side(b, 2) * side(c, 0) - side(b, 0) * side(c, 2),
          side(b, 0) * side(c, 1) - side(b, 1) * side(c, 0)];
}

/** The faces that are seen from the front, the farthest first. */
function inOrder(vertices, faces) {
  return faces.map((face) => ({ face, normal: normalOf(vertices, face),
                                depth: face.reduce((sum, i) => sum + vertices[3 * i + 2], 0) }))
    .filter(({ normal }) => normal[2] > 0).sort((one, other) => one.depth - other.depth);
}

/** Faces, each in one shade. colourOf(face) -> [red, green, blue] from 0 to 255. */
export function paint(context, vertices, faces, colourOf) {
  for (const { face, normal: [x, y, z] } of inOrder(vertices, faces)) {
    const facing = (x * LIGHT[0] + y * LIGHT[1] + z * LIGHT[2]) / Math.hypot(x, y, z);
    const shade = 0.45 + 0.55 * Math.abs(facing) ** 0.8;
    context.fillStyle = context.strokeStyle =
      `rgb(${colourOf(face).map((t) => Math.round(shade * t)).join(" ")})`;
    context.beginPath();
    trace(context, vertices, face);
    context.fill();
    context.stroke(); // closes the gap to the next face
  }
}

/** The outline of a mesh, to be filled. */
export function silhouette(vertices, faces) {
  const path = new Path2D();
  inOrder(vertices, faces).forEach(({ face }) => trace(path, vertices, face));
  return path;
}
