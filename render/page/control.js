// Changes a running session from its page: the network, the delay of inputs, the age of others'
// bodies. Each change is a command to the server of the room; a page without the token of the
// address only says what is set.

const CONTROLS = {
  impair: {name: 'Network', size: 12, list: true, hint: 'A profile, or delay=50ms,loss=1%,...'},
  show_age: {name: 'Show age', hint: 'The others are shown at most so many ticks ago'},
  input_delay: {name: 'Input delay', hint: 'An input acts so many ticks after it was read'},
};

class Control {
  constructor(source, token) {
    this.source = source;
    this.token = token;
    this.values = null;
    this.busy = false;
    this.work = Promise.resolve();  // commands go one after the other
    this.fields = {};
    this.form = element('form', '', {className: 'control'});
    this.form.setAttribute('aria-label', 'Change the running room');
    this.text = element('output', '', {className: 'control-text'});
    this.form.hidden = true;
    document.querySelector('.bar').after(this.form);
    if (token) this.addFields();
  }
  addFields() {
    for (const [key, {name, size, list, hint}] of Object.entries(CONTROLS)) {
      const input = element('input', undefined, {type: list ? 'text' : 'number', title: hint});
      input.autocomplete = 'off';
      input.spellcheck = false;
      if (list) {
        this.list = element('datalist', undefined, {id: 'profiles'});
        input.size = size;
        input.maxLength = 200;
        input.setAttribute('list', 'profiles');
        this.form.append(this.list);
      } else {
        input.min = 0;
        input.step = 1;
      }
      const label = element('label', `${name} `);
      const now = element('output');
      label.append(input, list ? '' : ' ticks');
      input.addEventListener('change', () => this.set(key));
      this.fields[key] = {input, now};
      const field = element('div', '', {className: 'field'});
      field.append(label, now);
      this.form.append(field);
    }
    const button = element('button', 'Set', {type: 'submit'});
    this.form.append(button, this.text);
    this.form.addEventListener('submit', (event) => {
      event.preventDefault();
      for (const key of Object.keys(CONTROLS)) this.set(key);
    });
  }

  // Shows the values that are set now; a field that was typed in keeps its text.
  show(values) {
    const before = this.values;
    this.values = values;
    this.form.hidden = false;
    if (!this.token) {
      const words = Object.entries(CONTROLS).map(([key, {name}]) => `${name} ${this.now(key)}`);
      this.text.textContent = `Set now: ${words.join(' · ')}`;
      this.form.append(this.text);
      return;
    }
    if (!before) this.list.append(...values.profiles.map((profile) => element('option', profile)));
    for (const [key, {input, now}] of Object.entries(this.fields)) {
      if (!before || input.value === this.valueOf(before, key))
        input.value = this.valueOf(values, key);
      if (values[key].most !== undefined) input.max = values[key].most;
      now.textContent = `now ${this.now(key)}`;
    }
  }
  valueOf(values, key) {
    return String(key === 'impair' ? values.impair : values[key].ticks);
  }
  now(key) {
    const {ticks} = this.values[key];
    if (ticks === undefined) return this.values.impair;
    return `${ticks} ticks (${Math.round(1000 * ticks / this.values.tick_hz)} ms)`;
  }
  set(key) {
    const {input} = this.fields[key];
    const value = input.value.trim();
    if (!this.values || value === this.valueOf(this.values, key)) return;
    this.send(`${key} ${value}`).then((why) => {
      this.text.textContent = why === '' ? `${CONTROLS[key].name} is now ${value}.` : why;
      if (why !== '') input.value = this.valueOf(this.values, key);
    });
  }

  // Sends a command after those before it; resolves to '', or to the reason of a refusal.
  send(command) {
    this.busy = true;
    this.work = this.work
                    .then(() => fetch(`control?token=${this.token}`, {
                            method: 'POST',
                            body: command,
                            keepalive: true,
                          }))
                    .then(async (answer) => (answer.ok ? '' : (await answer.text()).trim()))
                    .catch(() => 'The view is gone.')
                    .finally(() => (this.busy = false));
    return this.work;
  }
}
