// A way to a server that can be cut: connections break, and nobody can connect until it is opened again.
import { createServer, request } from 'node:http';

/** Stands before a server; its address is another one. */
export async function gateBefore(url) {
  const target = new URL(url);
  const pass = (asked, answer) => forward(target, asked, answer);
  let server = await listen(pass, 0);
  const { port } = server.address();
  const cut = () => new Promise((resolve) => {
    server.close(resolve);
    server.closeAllConnections();
  });
  return { url: `http://127.0.0.1:${port}${target.pathname}${target.search}`, cut, open: async () => void (server = await listen(pass, port)) };
}

function listen(pass, port) {
  const server = createServer(pass);
  return new Promise((resolve, reject) => server.on('error', reject).listen(port, '127.0.0.1', () => resolve(server)));
}

/** The server is to see its own address, as it refuses others. */
function forward(target, asked, answer) {
  const { origin, ...rest } = asked.headers;
  const headers = { ...rest, host: target.host, ...(origin ? { origin: target.origin } : {}) };
  const way = request({ host: target.hostname, port: target.port, path: asked.url, method: asked.method, headers }, (told) => {
    answer.writeHead(told.statusCode, told.headers);
    answer.flushHeaders();
    told.pipe(answer);
  });
  way.on('error', () => answer.destroy());
  answer.on('close', () => way.destroy());
  asked.pipe(way);
}
