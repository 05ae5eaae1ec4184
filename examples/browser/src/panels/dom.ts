// SPDX-License-Identifier: MIT

/** The element of the page with an id. */
export function byId<T extends HTMLElement = HTMLElement>(id: string): T {
  const element = document.getElementById(id);
  if (!element) throw new Error(`The page has no element "${id}".`);
  return element as T;
}

/** A new element with some properties and children. */
export function element<Name extends keyof HTMLElementTagNameMap>(
  name: Name,
  properties: Partial<HTMLElementTagNameMap[Name]> = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[Name] {
  const result = Object.assign(document.createElement(name), properties);
  result.append(...children);
  return result;
}

/** One of the page's icons. */
export function icon(name: string): SVGSVGElement {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('class', 'icon');
  svg.append(document.createElementNS('http://www.w3.org/2000/svg', 'use'));
  setIcon(svg, name);
  return svg;
}

export function setIcon(svg: Element, name: string): void {
  svg.querySelector('use')!.setAttribute('href', `#icon-${name}`);
}

/** A row of a list, and how it follows its item. */
export interface Row<Item> {
  element: HTMLElement;
  update(item: Item): void;
}

/**
 * Makes a list show items. Rows stay with their items, so that they keep the focus.
 *
 * @param key tells items apart
 */
export function rows<Item>(
  list: HTMLElement,
  key: (item: Item) => number,
  create: (key: number) => Row<Item>,
): (items: readonly Item[]) => void {
  const shown = new Map<number, Row<Item>>();
  return (items) => {
    const wanted = new Set(items.map(key));
    for (const [id, row] of shown)
      if (!wanted.has(id)) {
        row.element.remove();
        shown.delete(id);
      }
    items.forEach((item, i) => {
      const id = key(item);
      let row = shown.get(id);
      if (!row) shown.set(id, (row = create(id)));
      if (list.children[i] !== row.element) list.insertBefore(row.element, list.children[i] ?? null);
      row.update(item);
    });
  };
}

export function onClick(id: string, action: () => void): void {
  byId(id).addEventListener('click', action);
}

/** Tells a slider's number with each move. */
export function onSlide(id: string, action: (value: number) => void): void {
  const slider = byId<HTMLInputElement>(id);
  slider.addEventListener('input', () => action(slider.valueAsNumber));
}
