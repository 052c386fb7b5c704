// A cube in the corner of the picture that turns with the model; its faces say where they point, and turn the view there.
import { byId, element } from "./dom.js";

const kHalf = 22;  // pixels
const kLetters = { RAS: ["L", "R", "P", "A", "I", "S"], LPS: ["R", "L", "A", "P", "I", "S"] };
const kWords = { L: "left", R: "right", P: "posterior", A: "anterior", I: "inferior", S: "superior" };
// Of the faces at -x, x, -y, y, -z, z: the direction of a line of text, and of the lines down the face.
const kFaces = [
    { n: [-1, 0, 0], u: [0, -1, 0], v: [0, 0, -1] }, { n: [1, 0, 0], u: [0, 1, 0], v: [0, 0, -1] },
    { n: [0, -1, 0], u: [1, 0, 0], v: [0, 0, -1] }, { n: [0, 1, 0], u: [-1, 0, 0], v: [0, 0, -1] },
    { n: [0, 0, -1], u: [1, 0, 0], v: [0, 1, 0] }, { n: [0, 0, 1], u: [1, 0, 0], v: [0, -1, 0] },
];

/** Letters of patients where the space is known, else the axes. */
export const facesOf = (space) => kLetters[space] ?? ["−x", "x", "−y", "y", "−z", "z"];

/** `look(direction)` turns the view so that this direction points at the eye. */
export function addOrientation(stage, space, look) {
    const cube = element("div", { class: "cube" });
    facesOf(space).forEach((text, side) => {
        const { n, u, v } = kFaces[side], what = kWords[text] ?? text;
        const face = element("button", {
            type: "button", title: `View from ${what}`, "aria-label": `View from ${what}`, tabindex: "-1",
            onclick: () => look(n.map((x, axis) => (axis === 2 || n[2] === 0 ? x : -1e-4)).map((x, axis) => (axis === 2 && n[2] === 0 ? 1e-4 : x))),
        }, text);
        face.style.transform = `matrix3d(${[...u, 0, ...v, 0, ...n, 0, ...n.map((x) => kHalf * x), 1].join()})`;
        cube.append(face);
    });
    byId("orientation").append(cube);
    stage.addEventListener("drawn", () => {
        const [xx, xy, xz, , yx, yy, yz, , zx, zy, zz] = stage.camera.matrixWorldInverse.elements;
        cube.style.transform = `matrix3d(${[xx, -xy, xz, 0, yx, -yy, yz, 0, zx, -zy, zz, 0, 0, 0, 0, 1].map((x) => x.toFixed(5)).join()})`;
    });
}
