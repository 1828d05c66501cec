/** Meshes on a canvas, seen along -z. vertices: x, y, z of each, in a row. faces: [a, b, c]. */
import { html } from "./elements.js";
import { cross, dot, minus } from "./vectors.js";

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

function trace(path, [a, b, c]) {
  path.moveTo(a[0], a[1]);
  path.lineTo(b[0], b[1]);
  path.lineTo(c[0], c[1]);
  path.closePath();
}

/** The faces that are seen from the front, the farthest first. */
function inOrder(vertices, faces) {
  return faces.map((face) => {
    const corners = face.map((i) => [vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]]);
    const [a, b, c] = corners;
    return { face, corners, normal: cross(minus(b, a), minus(c, a)), depth: a[2] + b[2] + c[2] };
  }).filter(({ normal }) => normal[2] > 0).sort((one, other) => one.depth - other.depth);
}

/** Faces, each in one shade. colourOf(face) -> [red, green, blue] from 0 to 255. */
export function paint(context, vertices, faces, colourOf) {
  for (const { face, corners, normal } of inOrder(vertices, faces)) {
    const facing = dot(normal, LIGHT) / Math.hypot(...normal);
    const shade = 0.45 + 0.55 * Math.abs(facing) ** 0.8;
    context.fillStyle = context.strokeStyle =
      `rgb(${colourOf(face).map((t) => Math.round(shade * t)).join(" ")})`;
    context.beginPath();
    trace(context, corners);
    context.fill();
    context.stroke(); // closes the gap to the next face
  }
}

/** The outline of a mesh, to be filled. */
export function silhouette(vertices, faces) {
  const path = new Path2D();
  inOrder(vertices, faces).forEach(({ corners }) => trace(path, corners));
  return path;
}
