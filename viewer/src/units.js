// What the numbers of the page are measured in.
import { short } from "./dom.js";

/** A number and its unit of length, if the page knows one. */
export function lengthText(number, { unit }) {
    const factor = /^[0-9]/.test(unit ?? "") ? "× " : "";
    return unit ? `${short(number)} ${factor}${unit}` : short(number);
}

/** Few files say their unit of length; the page has it where one was found or given. */
export function unitText({ unit }) {
    if (!unit) return "Lengths, areas and volumes are in model units: those of the coordinates.";
    return /^[0-9]/.test(unit) ? `Lengths are in units of ${unit}, areas and volumes in their squares and cubes.` : `Lengths are in ${unit}, areas in ${unit}², volumes in ${unit}³.`;
}
