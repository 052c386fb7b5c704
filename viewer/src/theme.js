// Dark or light: as the system has it, until the button is pressed.
import { byId } from "./dom.js";

const kBackgrounds = { dark: "#14171c", light: "#f4f5f7" };

export function addTheme(setBackground) {
    const system = window.matchMedia("(prefers-color-scheme: dark)");
    let chosen = null;
    const apply = (theme) => {
        document.documentElement.dataset.theme = theme;
        setBackground(kBackgrounds[theme]);
    };
    const show = () => apply(chosen ?? (system.matches ? "dark" : "light"));
    window.addEventListener("beforeprint", () => apply("light"));  // paper is white
    window.addEventListener("afterprint", show);
    system.addEventListener("change", show);
    byId("theme").addEventListener("click", () => {
        chosen = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
        show();
    });
    show();
}
