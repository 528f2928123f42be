// SPDX-License-Identifier: Apache-2.0
// Lets people sort a table by the headings of its columns: a click sorts, a second one turns the order round, a third ends it.

export class Sorter {
  /** `values`: for each sortable column, by its index, a function that returns an item's number or text. */
  constructor(table, values, changed) {
    Object.assign(this, {values, column: null, down: false});
    this.heads = [...table.tHead.rows[0].cells];
    for (const at of Object.keys(values).map(Number)) {
      const head = this.heads[at], button = document.createElement('button');
      button.type = 'button';
      button.append(...head.childNodes);
      head.append(button);
      button.addEventListener('click', () => {
        const numeric = head.classList.contains('number'); // the largest first
        if (this.column !== at) Object.assign(this, {column: at, down: numeric});
        else if (this.down === numeric) this.down = !numeric;
        else this.column = null;
        this.heads.forEach((each, i) => {
          if (i !== this.column) each.removeAttribute('aria-sort');
          else each.setAttribute('aria-sort', this.down ? 'descending' : 'ascending');
        });
        changed();
      });
    }
  }

  /** Returns the items in the chosen order; without one, as they are. */
  sort(items) {
    if (this.column === null) return items;
    const value = this.values[this.column], sign = this.down ? -1 : 1, last = this.down ? -Infinity : Infinity;
    const of = (item) => value(item) ?? last;
    return items.map((item) => [of(item), item])
      .sort(([a], [b]) => sign * (typeof a === 'string' && typeof b === 'string' ? a.localeCompare(b, 'en', {numeric: true}) : a < b ? -1 : a > b ? 1 : 0))
      .map(([, item]) => item);
  }
}
