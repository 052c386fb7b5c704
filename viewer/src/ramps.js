// Scales of colours for numbers. Both can be read by colour-blind people.
import * as three from "three";

export const kRamps = {
    viridis: ["#440154", "#482878", "#3e4a89", "#31688e", "#26828e", "#1f9e89", "#35b779", "#6ece58", "#b5de2b", "#fde725"],
    vik: ["#0b3d82", "#2f6fae", "#79a9cf", "#c3d9e6", "#f2efec", "#edcfb5", "#d99a6c", "#b85e2b", "#7a2207"],
};

const textures = new Map();

/** 256 colours in a row. */
export function rampTexture(name) {
    if (textures.has(name)) return textures.get(name);
    const stops = kRamps[name].map((text) => parseInt(text.slice(1), 16)), data = new Uint8Array(4 * 256);
    for (let n = 0; n < 256; ++n) {
        const at = (n / 255) * (stops.length - 1), k = Math.min(Math.floor(at), stops.length - 2), share = at - k;
        for (const [place, shift] of [16, 8, 0].entries()) {
            const from = (stops[k] >> shift) & 255, to = (stops[k + 1] >> shift) & 255;
            data[4 * n + place] = Math.round(from + share * (to - from));
        }
        data[4 * n + 3] = 255;
    }
    const texture = new three.DataTexture(data, 256, 1, three.RGBAFormat);
    texture.magFilter = texture.minFilter = three.LinearFilter;
    texture.needsUpdate = true;
    textures.set(name, texture);
    return texture;
}
