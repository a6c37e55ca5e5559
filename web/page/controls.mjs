// A scene's settings as native inputs with labels, and as parameters of a link.

/** The initial values of all settings. */
export function defaults(scene) {
  return Object.fromEntries(scene.controls.filter(({ name }) => name).map(({ name, value }) => [name, value]));
}

/**
 * Sanitizes a value: numbers are clamped, choices must exist, anything else becomes the default.
 */
export function settled(control, text) {
  if (text === null || text === undefined) return control.value;
  if (control.kind === 'range') {
    const x = Number(text);
    return text !== '' && Number.isFinite(x) ? Math.min(Math.max(x, control.min), control.max) : control.value;
  }
  if (control.kind === 'choice') return control.options.some(([value]) => value === text) ? text : control.value;
  if (control.kind === 'check') return text === true || text === 'true';
  if (control.kind === 'colour') return /^#[0-9a-f]{6}$/.test(text) ? text : control.value;
  if (control.kind === 'place') {
    const words = String(text).split(',');
    return words.length === control.axes && words.every(word => word !== '' && Math.abs(word) < 1e5) ? words.join() : control.value;
  }
  if (control.kind === 'text') return (control.pattern ?? /^.*$/).test(text) ? String(text) : control.value;
  return control.value;
}

/** Returns link parameters of all non-default settings. */
export function linkOf(scene, settings) {
  const words = new URLSearchParams();
  for (const { name, value } of scene.controls) {
    if (name && settings[name] !== value) words.set(name, settings[name]);
  }
  return `#${scene.id}${words.size ? '?' + words : ''}`;
}

/** Returns the scene's settings from link parameters. */
export function settingsOf(scene, words) {
  const known = new URLSearchParams(words);
  return Object.fromEntries(scene.controls.filter(({ name }) => name).map(c => [c.name, settled(c, known.get(c.name))]));
}

/** Returns a user file, unless it exceeds the size limit. */
export function fitting(file) {
  if (file.size > 2e8) throw new Error(`${file.name} has ${Math.round(file.size / 1e6)} MB (at most 200).`);
  return file;
}

export const element = (tag, attributes = {}, ...children) => {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== false && value !== undefined) made.setAttribute(name, value === true ? '' : value);
  }
  made.append(...children);
  return made;
};

/**
 * Creates controls of a scene's settings in a form; `heard(name, value)` is called for each input.
 * The returned function sets the controls to settings. A control with `when(settings)` is visible
 * where it holds; `also(value)` of a choice returns additional settings.
 */
export function fields(scene, form, settings, heard) {
  form.replaceChildren();
  const setters = new Map(), shown = [];
  const show = values => { for (const [field, when] of shown) field.hidden = !when(values); };
  const changed = (name, value, also = {}) => {
    heard(name, value);
    for (const [other, its] of Object.entries(also)) {
      heard(other, its);
      setters.get(other)?.(its);
    }
    show(settings);
  };
  let group = form;
  for (const control of scene.controls) {
    const { name, kind, label } = control;
    if (kind === 'group') {
      group = element('fieldset', {}, element('legend', {}, label));
      form.append(group);
      if (control.when) shown.push([group, control.when]);
      continue;
    }
    if (kind === 'place' || kind === 'text') continue;
    const id = `${scene.id}-${name}`;
    if (kind === 'range') {
      const shown = element('output', { for: id });
      const input = element('input', { type: 'range', id, min: control.min, max: control.max, step: control.step ?? 'any' });
      const say = value => {
        const text = (control.says ? control.says(value) : String(+value.toPrecision(4))).replace('-', '−');
        shown.textContent = text;
        input.setAttribute('aria-valuetext', text);
      };
      input.addEventListener('input', () => { say(+input.value); changed(name, +input.value); });
      setters.set(name, value => { input.value = value; say(+value); });
      group.append(element('div', { class: 'field' }, element('label', { for: id }, label, ' ', shown), input));
    } else if (kind === 'choice') {
      const select = element('select', { id }, ...control.options.map(([value, text]) => element('option', { value }, text)));
      select.addEventListener('change', () => changed(name, select.value, control.also?.(select.value)));
      setters.set(name, value => { select.value = value; });
      group.append(element('div', { class: 'field' }, element('label', { for: id }, label), select));
    } else if (kind === 'check') {
      const input = element('input', { type: 'checkbox', id });
      input.addEventListener('change', () => changed(name, input.checked));
      setters.set(name, value => { input.checked = value; });
      group.append(element('div', { class: 'field check' }, input, element('label', { for: id }, label)));
    } else if (kind === 'colour') {
      const input = element('input', { type: 'color', id });
      input.addEventListener('input', () => changed(name, input.value));
      setters.set(name, value => { input.value = value; });
      group.append(element('div', { class: 'field colour' }, element('label', { for: id }, label), input));
    } else if (kind === 'file') {
      const input = element('input', { type: 'file', id, accept: control.accept });
      input.addEventListener('change', () => { if (input.files[0]) control.read(input.files[0]); input.value = ''; });
      group.append(element('div', { class: 'field' }, element('label', { for: id }, label), input));
    } else if (kind === 'button') {
      const button = element('button', { type: 'button', id }, label);
      button.addEventListener('click', control.press);
      group.append(button);
    } else if (kind === 'own') {
      group.append(control.element());
    }
    if (control.when) shown.push([group.lastElementChild, control.when]);
  }
  const set = values => {
    for (const [name, setter] of setters) setter(values[name]);
    show(values);
  };
  set(settings);
  return set;
}
