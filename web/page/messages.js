// What the page says in place of the picture, or over it.

import {byId} from './dom.js';

// In place of the picture.
export function showMessage(title, text) {
  const message = byId('message'), heading = document.createElement('b'), body = document.createElement('span');
  heading.textContent = title;
  body.textContent = text;
  message.replaceChildren(heading, body);
  message.hidden = false;
}

export function hideMessage() {
  byId('message').hidden = true;
  byId('message').replaceChildren();
}

// For a few seconds.
let noticeTimer = 0;
export function showNotice(text) {
  const notice = byId('notice');
  notice.textContent = text;
  notice.hidden = false;
  clearTimeout(noticeTimer);
  noticeTimer = setTimeout(() => { notice.hidden = true; }, 4000);
}
