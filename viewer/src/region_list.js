// The list of regions. Only the rows in view exist as elements, so that ten thousand regions cost what twenty do.
import { byId, counted, element, grouped, inOrder, labelNumber } from "./dom.js";
import { areaText, volumeText } from "./units.js";

const kRowHeight = 30;
const kOrders = {
    volume: { value: (region) => -region.measures.volume, text: (region, data) => volumeText(region.measures.volume, data, 3), head: "Volume" },
    area: { value: (region) => -region.measures.area, text: (region, data) => areaText(region.measures.area, data, 3), head: "Area" },
    faces: { value: (region) => -region.measures.faces, text: (region) => grouped(region.measures.faces), head: "Faces" },
    name: { value: (region) => region.title, text: (region) => region.label, head: "Label" },
    label: { value: (region) => labelNumber(region.label), text: (region) => region.label, head: "Label" },
};

export class RegionList {
    constructor(regions, lookAt, data) {
        this.regions = regions;
        this.data = data;
        this.lookAt = lookAt;
        this.box = byId("region-rows");
        this.space = element("div", { class: "row-space" });
        this.box.append(this.space);
        this.search = byId("region-search");
        this.order = byId("region-order");
        this.search.addEventListener("input", () => this.refilter());
        this.search.addEventListener("keydown", (event) => this.leaveSearch(event));
        this.order.addEventListener("change", () => this.refilter());
        this.box.addEventListener("scroll", () => this.draw());
        this.box.addEventListener("focusin", ({ target }) => {
            const row = target.closest(".row");
            if (row) this.active = this.found[Number(row.getAttribute("aria-posinset")) - 1];
        });
        this.box.addEventListener("keydown", (event) => this.moveFocus(event));
        new ResizeObserver(() => this.draw()).observe(this.box);
        regions.addEventListener("change", () => this.draw());
        for (const [id, act] of Object.entries({
            "show-all": () => regions.setState(regions.all, "solid"),
            "hide-all": () => regions.setState(this.found, "hidden"),
            "ghost-all": () => regions.setState(this.found, "ghost"),
            "only-found": () => this.showOnlyFound(),
        })) byId(id).addEventListener("click", act);
        this.refilter();
    }

    showOnlyFound() {
        const found = new Set(this.found);
        for (const region of this.regions.all) region.state = found.has(region) ? "solid" : "hidden";
        this.regions.changed();
    }

    refilter() {
        const words = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
        const { value, head } = kOrders[this.order.value];
        byId("row-value-head").textContent = head;
        this.found = this.regions.all.filter((region) => {
            const text = `${region.label} ${region.title}`.toLowerCase();
            return words.every((word) => text.includes(word));
        });
        this.found.sort((a, b) => inOrder(value(a), value(b)));
        this.box.scrollTop = 0;
        this.draw();
    }

    /** From the field into the list: the arrow goes to the first row, Enter selects it, too. */
    leaveSearch(event) {
        if (!["ArrowDown", "Enter"].includes(event.key) || this.found.length === 0) return;
        event.preventDefault();
        if (event.key === "Enter") this.choose(this.found[0]);
        this.space.querySelector('[aria-posinset="1"] .row-name')?.focus();
    }

    /** Selects a region, and shows it if it is hidden. */
    choose(region) {
        this.regions.select(region);
        if (region.state === "hidden") this.regions.setState([region], "solid");
    }

    countText() {
        const { all } = this.regions, hidden = all.filter((region) => region.state === "hidden").length;
        let text = `${grouped(this.found.length)} of ${counted(all.length, "region")}` + (hidden ? `, ${grouped(hidden)} hidden` : "");
        if (this.found.length === 0 && all.every(({ name }) => !name))
            text += ". These regions have labels only: the option --names TABLE gives them names.";
        return text;
    }

    /** Scrolls to a region, if it is in the list. */
    reveal(region) {
        const row = this.found.indexOf(region);
        if (row < 0) return;
        const top = row * kRowHeight, { scrollTop, clientHeight } = this.box;
        if (top < scrollTop || top + kRowHeight > scrollTop + clientHeight) this.box.scrollTop = top - clientHeight / 2;
        this.draw();
    }

    draw() {
        byId("region-count").textContent = this.countText();
        const first = Math.max(0, Math.floor(this.box.scrollTop / kRowHeight) - 4);
        const last = Math.min(this.found.length, Math.ceil((this.box.scrollTop + (this.box.clientHeight || 600)) / kRowHeight) + 4);
        this.space.style.height = `${this.found.length * kRowHeight}px`;
        const focused = document.activeElement?.dataset?.focus;
        this.space.replaceChildren();
        const active = this.found.indexOf(this.active), inView = Math.min(Math.ceil(this.box.scrollTop / kRowHeight), last - 1);
        const stop = first <= active && active < last ? active : inView;
        for (let n = first; n < last; ++n) this.space.append(this.row(n, n === stop));
        if (focused) this.space.querySelector(`[data-focus="${CSS.escape(focused)}"]`)?.focus({ preventScroll: true });
    }

    /** Tab stops at one row, `isStop`: behind the list the picture is one step away. */
    row(n, isStop) {
        const region = this.found[n], { regions } = this;
        const button = (kind, label, text, isPressed, act) =>
            element("button", {
                type: "button", class: `row-${kind}`, title: label, "aria-label": `${label}: ${region.title}`,
                "aria-pressed": isPressed === null ? null : String(isPressed), "data-focus": `${kind} ${region.label}`,
                tabindex: kind === "name" && isStop ? null : "-1", onclick: act,
            }, text);
        const swatch = element("span", { class: "swatch", "aria-hidden": "true" });
        swatch.style.background = region.colour;
        const name = button("name", "Select", region.title, regions.selected === region, () => this.choose(region));
        name.title = region.title;
        name.addEventListener("dblclick", () => this.lookAt(region));
        const row = element("div", {
            class: `row ${region.state}${regions.selected === region ? " selected" : ""}`, role: "listitem",
            "aria-setsize": this.found.length, "aria-posinset": n + 1,
        },
            button("eye", region.state === "hidden" ? "Show" : "Hide", region.state === "hidden" ? "○" : "●", null,
                () => regions.setState([region], region.state === "hidden" ? "solid" : "hidden")),
            swatch, name,
            element("span", { class: "row-value" }, kOrders[this.order.value].text(region, this.data)),
            button("ghost", "See through", "◌", region.state === "ghost",
                () => regions.setState([region], region.state === "ghost" ? "solid" : "ghost")),
            button("only", "Isolate", "◉", null, () => regions.isolate(region)));
        row.style.top = `${n * kRowHeight}px`;
        return row;
    }

    /** Arrow keys walk the list; right and left reach the buttons of a row. */
    moveFocus(event) {
        const now = document.activeElement?.closest?.(".row");
        if (!now || !["ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight"].includes(event.key)) return;
        event.preventDefault();
        event.stopPropagation();
        const buttons = [...now.querySelectorAll("button")], at = buttons.indexOf(document.activeElement);
        if (event.key === "ArrowLeft") buttons[Math.max(0, at - 1)].focus();
        else if (event.key === "ArrowRight") buttons[Math.min(buttons.length - 1, at + 1)].focus();
        else {
            const next = Number(now.getAttribute("aria-posinset")) - 1 + (event.key === "ArrowDown" ? 1 : -1);
            if (next < 0 || next >= this.found.length) return;
            this.reveal(this.found[next]);
            this.space.querySelector(`[aria-posinset="${next + 1}"] .row-name`)?.focus();
        }
    }
}
