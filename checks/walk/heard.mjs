// What pages complained of, and whom they asked.
import { require } from './cases.mjs';

export const heardCases = (heard) => [
  ['no page complains', async () => {
    require(heard.complaints.length === 0, `${heard.complaints.length} complaints, the first: ${heard.complaints[0]}`);
    return `no error and no warning in ${heard.pages} pages`;
  }],
  ['nobody but the server is asked', async () => {
    const isFar = (url) => !['file:', 'data:', 'blob:'].includes(new URL(url).protocol) && new URL(url).hostname !== '127.0.0.1';
    const far = heard.requests.filter(isFar);
    require(far.length === 0, `${far.length} requests leave the machine, the first: ${far[0]}`);
    return `${heard.requests.length} requests, none of them to another machine`;
  }],
];
