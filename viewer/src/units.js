// What the numbers of the page are measured in.
import { short } from "./dom.js";

/** A number and its unit of length, if the page knows one. */
export function lengthText(number, { unit }) {
    const factor = /^[0-9]/.test(unit ?? "") ? "× " : "";
    return unit ? `${short(number)} ${factor}${unit}` : short(number);
}

/** A number and its unit to a power: 2 for areas, 3 for volumes. */
export function powerText(number, power, { unit }, digits = 4) {
    if (!unit) return short(number, digits);
    const isNumber = /^[0-9]/.test(unit);
    return `${short(number, digits)} ${isNumber ? `× (${unit})` : unit}${power === 2 ? "²" : "³"}`;
}

export const areaText = (number, data, digits) => powerText(number, 2, data, digits);
export const volumeText = (number, data, digits) => powerText(number, 3, data, digits);

/** Few files say their unit of length; the page has it where one was found or given. */
export function unitText({ unit }) {
    if (!unit) return "Lengths, areas and volumes are in model units: those of the coordinates.";
    return /^[0-9]/.test(unit) ? `Lengths are in units of ${unit}, areas and volumes in their squares and cubes.` : `Lengths are in ${unit}, areas in ${unit}², volumes in ${unit}³.`;
}
