// A bar of a round length at the depth of the centre of the picture.
import { byId } from "./dom.js";
import { lengthText } from "./units.js";

const kMost = 130;  // pixels

/** The largest of 1, 2 and 5 times a power of ten that is not above. */
export function roundBelow(most) {
    const power = 10 ** Math.floor(Math.log10(most));
    return [5, 2, 1].find((digit) => digit * power <= most * (1 + 1e-12)) * power;
}

export function addScaleBar(stage, data) {
    const bar = byId("scale-bar"), text = byId("scale-text");
    stage.addEventListener("drawn", () => {
        const pixels = stage.canvas.clientHeight / (2 * stage.halfHeight * stage.camera.position.distanceTo(stage.controls.target));
        const length = roundBelow(kMost / pixels);
        if (!Number.isFinite(length)) return;
        bar.style.width = `${length * pixels}px`;
        text.textContent = lengthText(length, data);
    });
}
