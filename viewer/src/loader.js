// Unpacks the viewer and runs it. Says what to do where a browser cannot.
import { unpack } from "./unpack.js";

function say(text) {
    const box = document.getElementById("notice");
    box.textContent = text;
    box.hidden = false;
}

async function load() {
    if (typeof DecompressionStream === "undefined") {
        say("This browser is too old for the picture: use Firefox 113, Chrome 80, Safari 16.4 or later.");
        return;
    }
    const bytes = await unpack(document.getElementById("viewer").textContent);
    const script = document.createElement("script");
    script.textContent = new TextDecoder().decode(bytes);
    document.body.append(script);
}

document.documentElement.dataset.isWhole = "true";
load().catch((error) => say(`The page could not be unpacked: ${error.message}. Is the file complete?`));
