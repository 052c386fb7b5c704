// What the numbers of the page are measured in.

/** Few files say their unit of length; the page has it where the run was given one. */
export function unitText({ report }) {
    const unit = report?.options?.units;
    if (!unit) return "Lengths, areas and volumes are in model units: those of the coordinates.";
    return `Lengths are in ${unit}, areas in ${unit}², volumes in ${unit}³.`;
}
