// Elements. Text always goes in as text: names in files are not trusted.

/** An element with attributes and children; a child that is a string is text. `on...` are listeners. */
export function element(tag, attributes = {}, ...children) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
        else if (value === true) made.setAttribute(name, "");
        else if (value !== false && value !== null && value !== undefined) made.setAttribute(name, value);
    }
    made.append(...children.filter((child) => child !== null && child !== undefined && child !== false));
    return made;
}

export const byId = (id) => document.getElementById(id);

/** A name within a text: its direction of writing stays its own (Unicode, first strong isolate). */
export const isolated = (name) => `\u2068${name}\u2069`;

const kTexts = new Intl.Collator("en", { numeric: true, sensitivity: "base" });

/** For sort(): numbers, or texts in which "grain 2" comes before "Grain 10". */
export const inOrder = (a, b) => (typeof a === "string" && typeof b === "string" ? kTexts.compare(a, b) : a < b ? -1 : a > b ? 1 : 0);

/** 1234567 as 1,234,567. */
export const grouped = (count) => Math.round(count).toLocaleString("en");

/** "1 face", "2 faces". */
export const counted = (count, word, words = `${word}s`) => `${grouped(count)} ${count === 1 ? word : words}`;

/** For sort(): a label as a number. It is a text, since labels have up to 64 bits and a number of JavaScript has 53. */
export const labelNumber = (label) => (/^-?\d+$/.test(label) ? BigInt(label) : label);

/** A few digits. */
export function short(number, digits = 4) {
    if (number === null || number === undefined || !Number.isFinite(number)) return "–";
    if (number === 0) return "0";
    const size = Math.abs(number);
    if (size >= 1e7 || size < 1e-3) return number.toExponential(digits - 2);
    return size >= 1000 ? grouped(number) : String(Number(number.toPrecision(digits)));
}

/** A coordinate in a model of this extent, to the digits that the page holds: 1/65535 of it. */
export function coordinate(number, extent) {
    const digits = Math.ceil(Math.log10(65535 / extent));
    return digits <= 20 ? number.toLocaleString("en", { maximumFractionDigits: Math.max(digits, 0) }) : String(number);
}

export const percent = (share) => `${short(100 * share, 3)} %`;

export function download(name, type, content) {
    const link = element("a", { href: URL.createObjectURL(new Blob([content], { type })), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
