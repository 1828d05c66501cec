// Meshes that the reader turns. A still stands there until the reader asks for more. Only then is
// three.js loaded.
//
//   <figure class="orbit" data-shading="flat" data-eye="1.5 1.75 2.35"
//     data-meshes='[{"file": "ring.glb", "label": "64 faces"}]'><img alt="A ring"></figure>
//
// data-eye is where the still's camera stands. It looks at the origin, and up is y. Without
// data-eye the camera frames the first mesh.
import { make } from "./make.js";

const FIELD_OF_VIEW = 48;
const LIGHT = [-0.4, 0.6, 0.7], BRASS = [0.85, 0.66, 0.48]; // as in the course's pictures
const STEP = Math.PI / 24, NEARER = 0.9;
const HELP = "Turn: drag, or arrow keys. Zoom: wheel, two fingers, or + and -.";

export function show(figure) {
  const still = figure.querySelector("img");
  const stage = make("div", { className: "stage" });
  const button = make("button", { type: "button", className: "turn", textContent: "Turn it" });
  const told = make("p", { role: "status" });
  still.replaceWith(stage);
  stage.append(still, button);
  stage.after(told);
  const turn = async () => {
    const canvas = make("canvas", { tabIndex: 0, role: "application" });
    const context = canvas.getContext("webgl2", { antialias: true });
    canvas.ariaLabel = `${still.alt}. ${HELP}`;
    if (!context) {
      button.remove();
      told.textContent = "The picture stays still: this browser has no WebGL.";
      return;
    }
    told.textContent = "";
    button.textContent = "Loading";
    try {
      stage.after(await start(figure, canvas, context));
      stage.append(canvas);
      stage.classList.add("turns");
      canvas.focus({ preventScroll: true });
      button.remove();
    } catch {
      button.textContent = "Turn it";
      button.addEventListener("click", turn, { once: true });
      told.textContent = "The mesh did not load. Press the button to try again.";
    }
  };
  button.addEventListener("click", turn, { once: true });
}

// The canvas shows the first mesh -> the row of tools below it.
async function start(figure, canvas, context) {
  const three = await import("../vendor/three/three.min.js");
  const meshes = JSON.parse(figure.dataset.meshes);
  const view = new View(three, canvas, context, figure.dataset.shading === "flat");
  canvas.addEventListener("wheel", (event) => {
    if (!figure.contains(document.activeElement)) event.stopImmediatePropagation();
  }, { capture: true });
  await view.choose(meshes[0].file);
  view.begin(figure.dataset.eye?.split(" ").map(Number));
  new ResizeObserver(() => view.resize()).observe(canvas);
  return toolsOf(view, meshes);
}

class View {
  constructor(three, canvas, context, flat) {
    Object.assign(this, { three, canvas, flat, shapes: new Map() });
    this.renderer = new three.WebGLRenderer({ canvas, context, alpha: true });
    this.camera = new three.PerspectiveCamera(FIELD_OF_VIEW);
    this.controls = new three.OrbitControls(this.camera, canvas);
    this.controls.enablePan = false;
    canvas.style.touchAction = "pan-y"; // a swipe up or down scrolls the page, one aside turns
    this.lights = new three.Group();
    this.shape = new three.Group();
    this.scene = new three.Scene();
    this.scene.add(this.lights, this.shape);
    this.ink = new three.MeshBasicMaterial({ color: 0x1c1c1c, wireframe: true, visible: false });
    for (const light of [new three.HemisphereLight(0xffffff, 0x000000, Math.PI / 2),
      new three.DirectionalLight(0xffffff, Math.PI / 2)]) {
      light.position.fromArray(LIGHT);
      this.lights.add(light);
    }
    canvas.addEventListener("keydown", (event) => this.press(event));
    canvas.addEventListener("webglcontextrestored", () => this.draw());
  }

  // Show the mesh of this file. Of several that load at once, the one asked for last.
  async choose(file) {
    this.chosen = file;
    if (!this.shapes.has(file)) this.shapes.set(file, this.load(file));
    const shape = await this.shapes.get(file);
    if (this.chosen !== file) return;
    this.scene.remove(this.shape);
    this.scene.add(this.shape = shape);
    this.draw();
  }

  async load(file) {
    const { scene } = await new this.three.GLTFLoader().loadAsync(file).catch((error) => {
      this.shapes.delete(file); // the next try fetches it again
      throw error;
    });
    const parts = [];
    scene.traverse((part) => part.isMesh && parts.push(part));
    for (const part of parts) this.dress(part);
    return scene;
  }

  // Colours of the file where it has any, else brass. The faces' edges lie over it.
  dress(part) {
    const { map, vertexColors } = part.material;
    if (!part.geometry.attributes.normal) part.geometry.computeVertexNormals();
    part.material = new this.three.MeshLambertMaterial({
      map, vertexColors, flatShading: this.flat, side: this.three.DoubleSide,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    });
    if (!map && !vertexColors) part.material.color.fromArray(BRASS);
    part.add(new this.three.Mesh(part.geometry, this.ink));
  }

  // The camera's first place. From now on it draws when it moves, and the light goes with it.
  begin(eye) {
    const { camera, controls } = this;
    const sphere = new this.three.Box3().setFromObject(this.shape)
      .getBoundingSphere(new this.three.Sphere());
    const away = sphere.radius / Math.sin(Math.PI / 360 * FIELD_OF_VIEW);
    if (eye) {
      camera.position.fromArray(eye);
    } else {
      controls.target.copy(sphere.center);
      camera.position.set(0.4, 0.4, 1).setLength(away).add(sphere.center);
    }
    Object.assign(camera, { near: away / 100, far: 10 * away });
    Object.assign(controls, { minDistance: sphere.radius, maxDistance: 5 * away });
    controls.update();
    controls.saveState();
    this.first = camera.quaternion.clone().invert();
    controls.addEventListener("change", () => this.draw());
  }

  draw() {
    if (this.first) this.lights.quaternion.multiplyQuaternions(this.camera.quaternion, this.first);
    this.renderer.render(this.scene, this.camera);
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  // A key moves the mesh as the pointer would.
  press(event) {
    const { controls } = this;
    const move = {
      ArrowLeft: () => controls.rotateLeft(-STEP),
      ArrowRight: () => controls.rotateLeft(STEP),
      ArrowUp: () => controls.rotateUp(-STEP),
      ArrowDown: () => controls.rotateUp(STEP),
      "+": () => controls.dollyIn(NEARER),
      "=": () => controls.dollyIn(NEARER),
      "-": () => controls.dollyOut(NEARER),
    }[event.key];
    if (!move || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    move();
  }
}

function toolsOf(view, meshes) {
  const tools = make("div", { className: "tools" });
  const label = make("span", { textContent: meshes[0].label });
  const slider = make("input", { type: "range", max: meshes.length - 1, value: 0 });
  const edges = make("button", { type: "button", textContent: "Edges", ariaPressed: "false" });
  const reset = make("button", { type: "button", textContent: "Reset view" });
  Object.assign(slider, { ariaLabel: "Which mesh", ariaValueText: meshes[0].label });
  let shown = meshes[0];
  slider.addEventListener("input", async () => {
    const wanted = meshes[slider.value];
    const isThere = await view.choose(wanted.file).then(() => true, () => false);
    if (wanted.file !== view.chosen) return;
    if (isThere) shown = wanted;
    slider.value = meshes.indexOf(shown);
    slider.ariaValueText = label.textContent = isThere ? shown.label
      : `${shown.label}. The mesh of ${wanted.label} did not load: move the slider to try again.`;
  });
  edges.addEventListener("click", () => {
    edges.ariaPressed = String(view.ink.visible = !view.ink.visible);
    view.draw();
  });
  reset.addEventListener("click", () => view.controls.reset());
  tools.append(label);
  if (meshes.length > 1) tools.append(slider);
  tools.append(edges, reset, make("p", { textContent: HELP }));
  return tools;
}
