// Shows the numbers of a slot; "\" and µ are here for who embeds this.
export default class extends HTMLElement {
  connectedCallback() {
    this.host.watch(`slot:${this.placement.slots.sample}`, (reading) => {
      this.textContent = reading.value === null ? reading.reason : String(reading.value.number);
    });
  }
}
