// Dark or light: as the system has it, until the button is pressed.
import { byId } from "./dom.js";

const kBackgrounds = { dark: "#14171c", light: "#f4f5f7" };

export function addTheme(setBackground) {
    const system = window.matchMedia("(prefers-color-scheme: dark)");
    let chosen = null;
    const show = () => {
        const theme = chosen ?? (system.matches ? "dark" : "light");
        document.documentElement.dataset.theme = theme;
        setBackground(kBackgrounds[theme]);
    };
    system.addEventListener("change", show);
    byId("theme").addEventListener("click", () => {
        chosen = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
        show();
    });
    show();
}
