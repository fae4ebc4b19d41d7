//! A server on a thread of its own.

use crate::connection::{Door, talk};
use crate::error::ServeError;
use crate::feed::Feed;
use crate::guard::Guard;
use crate::page::{Page, Sealed};
use crate::routes::router;
use crate::settings::{Limits, Settings};
use crate::shown::Shown;
use crate::site::{Gates, Site};
use crate::stopping::{Stopper, Stopping};
use crate::token::Token;
use hyper_util::service::TowerToHyperService;
use std::fmt;
use std::net::{Ipv4Addr, Ipv6Addr, SocketAddr, TcpListener};
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::time::Duration;
use tokio::runtime::{Builder, Runtime};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::time::{sleep, timeout};

/// A server that stops has this time to finish its responses,
const FINISH: Duration = Duration::from_millis(600);
/// and this to finish its calls. Calls that take longer end on threads that nobody waits for.
const GIVE_UP: Duration = Duration::from_millis(200);
/// Time to recover when the system has no more connections to give.
const REST: Duration = Duration::from_millis(50);

/// A server that runs. It stops when it is dropped.
pub struct Server {
    address: SocketAddr,
    url: String,
    site: Arc<Site>,
    stopper: Stopper,
    thread: Option<JoinHandle<()>>,
}

/// Serves what is shown, on a thread of its own; comes back once the server listens.
pub fn serve(
    settings: Settings,
    page: &Page,
    shown: Arc<dyn Shown>,
    feed: Feed,
) -> Result<Server, ServeError> {
    let Settings { address, port, token, limits } = settings;
    let token = Token::choose(address, token)?;
    let asked = SocketAddr::new(address, port);
    let listener = listener(asked)?;
    let address = listener.local_addr().map_err(|e| ServeError::listening(asked, e))?;
    let url = url(address, token.as_ref());
    let stopper = Stopper::new();
    let site = Site {
        page: Sealed::new(page)?,
        feed,
        shown,
        limits,
        stopping: stopper.stopping(),
        seats: Arc::new(Semaphore::new(limits.viewers.into())),
        gates: Gates::new(&limits),
    };
    let site = Arc::new(site);
    let thread = start(listener, Arc::clone(&site), Guard::new(address, token));
    let thread = Some(thread.map_err(ServeError::Thread)?);
    Ok(Server { address, url, site, stopper, thread })
}

impl Server {
    /// Where it listens.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// What to open in a browser on this machine, with the token if there is one.
    pub fn url(&self) -> &str {
        &self.url
    }

    /// How many streams of events are open.
    pub fn viewers(&self) -> usize {
        usize::from(self.site.limits.viewers) - self.site.seats.available_permits()
    }

    /// What stops the server from another thread.
    pub fn stopper(&self) -> Stopper {
        self.stopper.clone()
    }

    /// Stops, within about a second.
    pub fn stop(self) {
        drop(self);
    }

    /// Waits until a [`Stopper`] stops the server.
    pub fn wait(mut self) {
        self.join();
    }

    fn join(&mut self) {
        if let Some(thread) = self.thread.take() {
            // A thread that panicked has said so, and is as much at its end as any.
            let _ = thread.join();
        }
    }
}

impl fmt::Debug for Server {
    /// Without the token, which is nothing for a log.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Server").field("address", &self.address).finish_non_exhaustive()
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.stopper.stop();
        self.join();
    }
}

fn listener(address: SocketAddr) -> Result<TcpListener, ServeError> {
    let listener = TcpListener::bind(address).map_err(|e| ServeError::listening(address, e))?;
    listener.set_nonblocking(true).map_err(|e| ServeError::listening(address, e))?;
    Ok(listener)
}

/// An address that can be opened on this machine.
fn url(address: SocketAddr, token: Option<&Token>) -> String {
    let mut address = address;
    if address.ip().is_unspecified() {
        let own =
            if address.is_ipv4() { Ipv4Addr::LOCALHOST.into() } else { Ipv6Addr::LOCALHOST.into() };
        address.set_ip(own);
    }
    let query = token.map(|token| format!("?token={}", token.text())).unwrap_or_default();
    format!("http://{address}/{query}")
}

fn start(listener: TcpListener, site: Arc<Site>, guard: Guard) -> std::io::Result<JoinHandle<()>> {
    let runtime = runtime(&site.limits)?;
    let listener = {
        let _inside = runtime.enter();
        tokio::net::TcpListener::from_std(listener)?
    };
    let serving = thread::Builder::new().name("isolux-serve".to_owned());
    serving.spawn(move || {
        runtime.block_on(until_stopped(listener, site, guard));
        runtime.shutdown_timeout(GIVE_UP);
    })
}

/// One thread for connections, and one for each call that may wait.
fn runtime(limits: &Limits) -> std::io::Result<Runtime> {
    let kinds = [limits.readings.max(1), limits.containers.max(1), 1];
    let calls = kinds.into_iter().map(usize::from).sum();
    Builder::new_current_thread().enable_io().enable_time().max_blocking_threads(calls).build()
}

async fn until_stopped(listener: tokio::net::TcpListener, site: Arc<Site>, guard: Guard) {
    let Limits { connections, patience, .. } = site.limits;
    let stopping = site.stopping.clone();
    let router = TowerToHyperService::new(router(site));
    let door = Arc::new(Door { guard, router, patience });
    let connections = connections.max(1);
    let places = Arc::new(Semaphore::new(connections.into()));
    accept(listener, door, stopping, &places).await;
    // Whoever is late is cut off.
    let _ = timeout(FINISH, places.acquire_many(connections.into())).await;
}

/// Takes connections, as many at once as there are places, until the server stops.
async fn accept(
    listener: tokio::net::TcpListener,
    door: Arc<Door>,
    mut stopping: Stopping,
    places: &Arc<Semaphore>,
) {
    loop {
        let (stream, place) = tokio::select! {
            () = stopping.told() => return,
            connection = connection(&listener, places) => connection,
        };
        let (door, stopping) = (Arc::clone(&door), stopping.clone());
        tokio::spawn(async move {
            talk(stream, door, stopping).await;
            drop(place);
        });
    }
}

/// The next connection, once there is a place for it.
async fn connection(
    listener: &tokio::net::TcpListener,
    places: &Arc<Semaphore>,
) -> (tokio::net::TcpStream, OwnedSemaphorePermit) {
    let place = Arc::clone(places).acquire_owned().await.expect("places are never closed");
    loop {
        match listener.accept().await {
            Ok((stream, _)) => return (stream, place),
            Err(_) => sleep(REST).await,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::net::IpAddr;

    #[test]
    fn urls_can_be_opened_here() {
        let url = |ip: IpAddr, token| {
            let token = Token::choose(Ipv4Addr::LOCALHOST.into(), token).unwrap();
            super::url(SocketAddr::new(ip, 8000), token.as_ref())
        };
        let token = || Some("0123456789abcdef".to_owned());
        assert_eq!(url(Ipv4Addr::LOCALHOST.into(), None), "http://127.0.0.1:8000/");
        assert_eq!(url(Ipv6Addr::LOCALHOST.into(), None), "http://[::1]:8000/");
        assert_eq!(
            url(Ipv4Addr::UNSPECIFIED.into(), token()),
            "http://127.0.0.1:8000/?token=0123456789abcdef"
        );
        assert_eq!(
            url(Ipv6Addr::UNSPECIFIED.into(), token()),
            "http://[::1]:8000/?token=0123456789abcdef"
        );
    }
}
