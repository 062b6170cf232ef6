// Offers posts of the kit for a form without text.

import { element } from "./element.ts";

export interface KitPost {
  name: string;
  about: string;
  text: string;
}

export class Kit {
  readonly root = element("div", { class: "kit", role: "group", "aria-label": "Begin with a post", hidden: "" });
  private readonly units = element("select", { "aria-label": "Units" },
    ...[["both", "both units"], ["mm", "millimetres"], ["inch", "inches"]].map(([value, name]) => element("option", { value }, name)));
  private readonly list = element("ul", {});
  onPick: (text: string) => void = () => {};

  constructor() {
    this.root.append(element("p", {}, element("b", {}, "This form is empty."), " Type, or begin with a post for a control like yours; nothing is written before you save."), element("label", {}, "Units ", this.units), this.list);
  }

  show(posts: KitPost[] | null): void {
    this.root.hidden = !posts;
    if (!posts || this.list.childElementCount) return;
    this.list.append(...posts.map((post) => {
      const button = element("button", {}, element("b", {}, post.name), ` ${post.about}`);
      button.onclick = () => this.onPick(this.inUnits(post.text));
      return element("li", {}, button);
    }));
  }

  /** The text of a post for the selected units. */
  private inUnits(text: string): string {
    return this.units.value === "both" ? text : text.replace(/^Units both$/m, `Units ${this.units.value}`);
  }
}
