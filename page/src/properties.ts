// The properties of a form: yes or no, a choice, a number, a text. A changed value is shown at once, but is not written into the form.

import { element } from "./element.ts";

export interface Property {
  name: string;
  kind: "number" | "length" | "angle" | "yesno" | "text" | "choice";
  choices: string[];
  default: string;
  text: string;
}

export class Properties {
  readonly button = element("button", { class: "toggle", "aria-expanded": "false", title: "The properties of the form: what `--set` sets", hidden: "" });
  readonly root = element("div", { class: "properties", role: "group", "aria-label": "Properties of the form", hidden: "" });
  private shown = "";
  /** Values that differ from the defaults, by property name. */
  private values = new Map<string, string>();
  onChange: () => void = () => {};

  constructor() {
    this.button.onclick = () => {
      this.root.hidden = !this.root.hidden;
      this.button.setAttribute("aria-expanded", String(!this.root.hidden));
    };
  }

  /** Names and values that differ from the defaults. */
  get set(): [string, string][] {
    return [...this.values];
  }

  show(properties: Property[], units: string): void {
    this.button.hidden = !properties.length;
    if (!properties.length) this.root.hidden = true;
    const shown = JSON.stringify([properties, units]);
    if (shown !== this.shown) this.root.replaceChildren(...properties.map((property) => this.row(property, units)));
    this.shown = shown;
    this.tell();
  }

  forget(): void {
    this.values.clear();
    this.shown = "";
  }

  private tell(): void {
    this.button.textContent = `properties${this.values.size ? ` (${this.values.size} set)` : ""}`;
  }

  private row(property: Property, units: string): HTMLElement {
    const { name, choices, kind } = property;
    const value = this.values.get(name) ?? property.default;
    const field = choices.length
      ? element("select", {}, ...choices.map((choice) => element("option", choice === value ? { selected: "" } : {}, choice)))
      : element("input", { type: "text", value, inputmode: kind === "text" ? "text" : "decimal", spellcheck: "false" });
    field.setAttribute("aria-label", property.text);
    field.onchange = () => {
      if (field.value === property.default) this.values.delete(name);
      else this.values.set(name, field.value);
      this.tell();
      this.onChange();
    };
    const unit = { length: units, angle: "°" }[kind as string];
    return element("label", { title: `--set ${name}=…` }, element("span", {}, property.text || name), field, unit ?? "");
  }
}
