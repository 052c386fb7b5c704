// The regions of all models of the page: one entry for each label, whichever models have it.
import { regionMeasures } from "./measures.js";

export class Regions extends EventTarget {
    constructor(models) {
        super();
        this.models = models;
        this.measures = models.map(regionMeasures);
        const byLabel = new Map();
        models.forEach((model, which) =>
            model.labels.forEach((entry, place) => {
                if (entry.background || this.measures[which][place].faces === 0) return;
                if (!byLabel.has(entry.label))
                    byLabel.set(entry.label, { label: entry.label, name: entry.name ?? "", colour: entry.colour, state: "solid", places: [] });
                byLabel.get(entry.label).places[which] = place;
            }),
        );
        this.all = [...byLabel.values()];
        this.byLabel = byLabel;
        this.selected = null;
        for (const region of this.all) {
            region.first = region.places.findIndex((place) => place !== undefined);  // model that has it
            region.measures = this.measures[region.first][region.places[region.first]];
            region.title = region.name || `region ${region.label}`;
        }
    }

    /** The region of a place in the labels of a model; null for background and outside. */
    at(which, place) {
        const entry = this.models[which].labels[place];
        return (entry && this.byLabel.get(entry.label)) ?? null;
    }

    titleAt(which, place) {
        const model = this.models[which], entry = model.labels[place];
        if (!entry) return "outside";
        return this.at(which, place)?.title ?? (entry.name || `background ${entry.label}`);
    }

    changed() { this.dispatchEvent(new Event("change")); }

    setState(regions, state) {
        for (const region of regions) region.state = state;
        this.changed();
    }

    /** Hides all others, or shows all where the region is alone already. */
    isolate(region) {
        const isAlone = this.all.every((other) => (other === region) === (other.state !== "hidden"));
        for (const other of this.all) other.state = isAlone || other === region ? "solid" : "hidden";
        this.changed();
    }

    /** Hides all regions but those with these labels of a model. */
    showOnly(which, places) {
        const wanted = new Set([...places].map((place) => this.at(which, place)));
        for (const region of this.all) region.state = wanted.has(region) ? "solid" : "hidden";
        this.changed();
    }

    select(region) {
        this.selected = region;
        this.changed();
    }

    /** For each model, by label: the colour and state to draw. */
    drawnStates(which) {
        return this.models[which].labels.map((entry, place) => {
            const region = this.at(which, place);
            return { colour: region?.colour ?? entry.colour, state: region?.state ?? "hidden" };
        });
    }

    shown(which) { return this.drawnStates(which).map(({ state }) => state !== "hidden"); }

    /** Displacements by label for the exploded view at 1: away from the centre of the box. */
    offsets(which) { return this.measures[which].map(({ centroid }) => centroid.map((x) => 1.2 * x)); }
}
