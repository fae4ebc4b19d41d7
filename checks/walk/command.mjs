// The command line, as a user runs it in a folder.
import { spawn } from 'node:child_process';

/** Runs and serves with one binary in one folder; `end` interrupts what still serves. */
export function commandIn(binary, folder) {
  const serving = new Set();
  return {
    run: (...flags) => run(binary, folder, flags),
    serve: async (...flags) => {
      const served = await serve(binary, folder, flags);
      serving.add(served);
      return served;
    },
    end: () => Promise.all([...serving].map(({ stop }) => stop())),
  };
}

/** What a command prints; it must end well. */
function run(binary, folder, flags) {
  const child = spawn(binary, flags, { cwd: folder, stdio: ['ignore', 'pipe', 'pipe'] });
  const [printed, said] = [child.stdout, child.stderr].map(collect);
  return new Promise((resolve, reject) => {
    child.on('error', reject);
    child.on('close', (code) => (code === 0 ? resolve(printed.text) : reject(new Error(`isolux ${flags.join(' ')}: exit code ${code}: ${said.text}`))));
  });
}

function collect(stream) {
  const all = { text: '' };
  stream.setEncoding('utf8').on('data', (part) => (all.text += part));
  return all;
}

/** A command that serves a page: its address, the exit code that it will have, and what interrupts it. */
async function serve(binary, folder, flags) {
  const child = spawn(binary, [...flags, '--no-open'], { cwd: folder, stdio: ['ignore', 'pipe', 'pipe'] });
  const ended = new Promise((resolve) => child.on('close', resolve));
  const stop = () => {
    child.kill('SIGINT');
    return ended;
  };
  return { url: await addressOf(child, flags), ended, stop };
}

function addressOf(child, flags) {
  const heard = [child.stdout, child.stderr].map(collect);
  return new Promise((resolve, reject) => {
    const look = () => {
      const found = heard.map(({ text }) => /http:\/\/\S+\s/.exec(text)).find(Boolean);
      if (found) resolve(found[0].trim());
    };
    for (const stream of [child.stdout, child.stderr]) stream.on('data', look);
    child.on('error', reject);
    child.on('close', (code) => reject(new Error(`isolux ${flags.join(' ')} serves nothing: exit code ${code}: ${heard[1].text}`)));
  });
}
